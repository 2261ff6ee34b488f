// SPDX-License-Identifier: Apache-2.0
// Rays, or other rows of numbers, as they come, block by block, so that no number of them has to fit in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// What rows of an input are, for readers and their messages.
struct RowKind {
    std::string row, rows;           ///< "ray", "rays"
    std::vector<std::size_t> widths; ///< numbers that a row may have
    std::string numbers;             ///< which these are: "6: origin and direction"
    std::string shape;               ///< the same of arrays: "(N, 6): origin and direction"
    /// Where text names its columns, they must be the first ones of these; empty: any names will do.
    std::vector<std::string> names = {};
};
extern const RowKind kRayRows;

/// Consecutive rays. One of the two arrays holds them, six numbers each, or as many as a row has.
struct RayBlock {
    /// Four chunks of the library's, which keep its slots at work; 48 MiB of doubles.
    static constexpr std::size_t kRays = std::size_t{1} << 20;

    std::uint64_t first = 0; ///< number of the first one, from 0
    std::vector<double> doubles;
    std::vector<float> floats;
    std::vector<std::uint64_t> lines; ///< of each ray, from 1, where they come as text

    RayRows rows() const {
        return floats.empty() ? RayRows(std::span<const double>(doubles)) : RayRows(std::span<const float>(floats));
    }
};

class RaySource {
public:
    virtual ~RaySource() = default;
    /// The next rays, up to RayBlock::kRays, in place of those in block; false where there are none any more. Throws
    /// Error kBadInput "NAME[:LINE]: reason".
    virtual bool next(RayBlock& block) = 0;
    /// Numbers of a row; of text, of those read so far.
    virtual std::size_t width() const = 0;
    /// How many there are in all, where that is known beforehand.
    virtual std::optional<std::uint64_t> count() const = 0;
    /// "NAME: ray 17" or "NAME:18", for messages.
    virtual std::string placeOf(const RayBlock& block, std::size_t ray) const = 0;
};

/// Rays of a file, or of standard input for "-": a NumPy array (.npy) where the first bytes are of one, else text.
/// Throws Error kBadInput "NAME: reason" for an array that does not hold rays.
/// @param kind lives as long as what is returned
std::unique_ptr<RaySource> openRays(const std::string& path, const RowKind& kind = kRayRows);

} // namespace pointrt
