// SPDX-License-Identifier: Apache-2.0
// Where points go, block by block, as they come: PLY, LAS, LAZ and text.
#pragma once

#include <memory>
#include <string>

#include "format/base/atomic_file.h"
#include "format/pointio/point_columns.h"

namespace pointrt {

/// What is written appears whole under its name with finish, or not at all; standard output gets it as it comes. Each
/// function throws Error kCannotWrite "PATH: reason".
class PointSink {
public:
    virtual ~PointSink() = default;
    /// The next points. Throws Error kBadInput for those that the format cannot hold (LAS: too far away, not finite).
    virtual void add(const PointBlock& block) = 0;
    virtual void finish() = 0;
};

enum class PointFormat { kPly, kLas, kLaz, kCsv };

/// By the name's end; "-" is PLY. Throws Error kBadUsage "PATH: points are written as ..." where the name says nothing.
PointFormat pointFormat(const std::string& path);

/// Opens path, by its name's end:
/// - .ply: binary little-endian, double x y z, then a property for each component (NAME, or NAME_0 ... of several;
///   64-bit integers as double)
/// - .las, .laz: as planLas says
/// - .csv: text under a line of names, numbers as short as they read the same
/// @param existing kKept: one that has the name already is an error, which names --force
/// Throws Error: kCannotWrite; kBadUsage as pointFormat; kCannotRun for LAZ in a build without it.
std::unique_ptr<PointSink> openPointSink(const std::string& path, const PointOutline& outline,
                                         format::Existing existing = format::Existing::kReplaced);

} // namespace pointrt
