// SPDX-License-Identifier: Apache-2.0
// Outputs of hits, written block by block.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "runtime/rays/hit_columns.h"

namespace pointrt {

/// A file appears under its name when finish has completed it; standard output is written at once. Every function
/// throws Error kCannotWrite "PATH: reason".
class HitSink {
public:
    virtual ~HitSink() = default;
    /// Appends the hits of the next rays, which are numbered from first. Every call passes the same columns.
    virtual void add(std::span<const HitColumn> columns, std::uint64_t first) = 0;
    virtual void finish() = 0;
};

/// The output to open.
struct SinkRequest {
    std::string path;                   ///< "-": standard output
    std::optional<std::uint64_t> count; ///< of rays, if known in advance
    bool any = false;                   ///< columns are occlusionColumns()
};

enum class SinkKind { kNpz, kNpy, kCsv, kPly };

/// The kind of output that the suffix selects; "-" is an array if the number of rays is known, else text. Throws Error
/// kBadUsage for other suffixes, and for PLY with any.
SinkKind sinkKind(const SinkRequest& request);

/// Opens an output of the kind that sinkKind returns. Throws as sinkKind does.
/// @param columns the columns that all blocks will have; their values are ignored
std::unique_ptr<HitSink> openSink(const SinkRequest& request, std::span<const HitColumn> columns);

} // namespace pointrt
