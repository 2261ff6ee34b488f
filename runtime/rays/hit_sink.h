// SPDX-License-Identifier: Apache-2.0
// Where hits go, block by block, as they come.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "runtime/rays/hit_columns.h"

namespace pointrt {

/// What is written appears whole under its name with finish, or not at all; standard output gets it as it comes. Each
/// function throws Error kCannotWrite "PATH: reason".
class HitSink {
public:
    virtual ~HitSink() = default;
    /// Columns of the next rays, first of them with this number; always the same columns.
    virtual void add(std::span<const HitColumn> columns, std::uint64_t first) = 0;
    virtual void finish() = 0;
};

/// What an output is to be.
struct SinkRequest {
    std::string path;                   ///< "-": standard output
    std::optional<std::uint64_t> count; ///< of rays, where it is known beforehand
    bool any = false;                   ///< columns are anyColumns
};

enum class SinkKind { kNpz, kNpy, kCsv, kPly };

/// By the name's end; "-" is an array where the number of rays is known, else text. Throws Error kBadUsage where the
/// name says nothing, or what cannot be.
SinkKind sinkKind(const SinkRequest& request);

/// @param columns as they will come, without values
std::unique_ptr<HitSink> openSink(const SinkRequest& request, std::span<const HitColumn> columns);

} // namespace pointrt
