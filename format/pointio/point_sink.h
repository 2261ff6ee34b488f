// SPDX-License-Identifier: Apache-2.0
// Writes points as PLY, PCD, LAS, LAZ, E57 or text, block by block.
#pragma once

#include <memory>
#include <string>

#include "format/os/atomic_file.h"
#include "format/pointio/point_columns.h"

namespace pointrt {

/// A file appears under its name when finish has completed it; standard output is written at once. Every function
/// throws Error kCannotWrite "PATH: reason".
class PointSink {
public:
    virtual ~PointSink() = default;
    /// Appends points. Throws Error kBadInput for points that the format cannot hold (LAS: too far away, not finite).
    virtual void add(const PointBlock& block) = 0;
    virtual void finish() = 0;
};

enum class PointFormat { kPly, kLas, kLaz, kCsv, kPcd, kE57 };

/// The format for a suffix; "-" is PLY. Throws Error kBadUsage for other suffixes.
PointFormat pointFormat(const std::string& path);

/// Opens path for writing, in the format of its suffix:
/// - .ply: binary little-endian, double x y z, then a property for each component (NAME, or NAME_0 ... of several;
///   64-bit integers as double)
/// - .las, .laz: see planLas
/// - .pcd: version 0.7, binary; positions as floats if these are precise enough, else as doubles
/// - .e57: one scan in metres, without a coordinate system; attributes without a name in the standard are an extension
///   "pointrt:NAME"
/// - .csv: text with a line of names; numbers in their shortest exact form
/// @param existing kKept: an existing file is an error, which mentions --force
/// Throws Error: kCannotWrite; kBadUsage as pointFormat; kCannotRun for LAZ in a build without it.
std::unique_ptr<PointSink> openPointSink(const std::string& path, const PointOutline& outline,
                                         format::Existing existing = format::Existing::kReplaced);

} // namespace pointrt
