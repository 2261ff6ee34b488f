// SPDX-License-Identifier: Apache-2.0
// Rays, or other rows of numbers, read block by block: any number of them, in constant memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// The kind of rows that an input has, for readers and their messages.
struct RowKind {
    std::string row, rows;           ///< "ray", "rays"
    std::vector<std::size_t> widths; ///< numbers that a row can have
    std::string numbers;             ///< "6: origin and direction"
    std::string shape;               ///< of arrays: "(N, 6): origin and direction"
    /// The column names that a text file may have; a narrower row has the first of them. Empty: any names.
    std::vector<std::string> names = {};
};
extern const RowKind kRayRows;

/// Consecutive rays, in one of the two arrays: six numbers for each, or as many as a row has.
struct RayBlock {
    /// Four of the library's chunks, to keep all of its slots busy; 48 MiB of doubles.
    static constexpr std::size_t kRays = std::size_t{1} << 20;

    std::uint64_t first = 0; ///< index of the first ray, from 0
    std::vector<double> doubles;
    std::vector<float> floats;
    std::vector<std::uint64_t> lines; ///< line of each ray, from 1, if read from text

    RayRows rows() const {
        return floats.empty() ? RayRows(std::span<const double>(doubles)) : RayRows(std::span<const float>(floats));
    }
};

class RaySource {
public:
    virtual ~RaySource() = default;
    /// Overwrites block with the next rays, at most RayBlock::kRays. False at the end. Throws Error kBadInput
    /// "NAME[:LINE]: reason".
    virtual bool next(RayBlock& block) = 0;
    /// Numbers in a row; for text, known after the first row.
    virtual std::size_t width() const = 0;
    /// The number of rays, if known in advance.
    virtual std::optional<std::uint64_t> count() const = 0;
    /// "NAME: ray 17" or "NAME:18", for messages.
    virtual std::string placeOf(const RayBlock& block, std::size_t ray) const = 0;
};

/// Opens rays in a file, or on standard input for "-": a NumPy array if the first bytes say so, else text. Throws Error
/// kBadInput "NAME: reason" for an array that does not hold rays.
/// @param kind must outlive the result
std::unique_ptr<RaySource> openRays(const std::string& path, const RowKind& kind = kRayRows);

} // namespace pointrt
