// SPDX-License-Identifier: GPL-3.0-or-later
// Which points are wanted: told one by one while files are read, so that the others take no memory.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct FilterOptions {
    std::optional<Eigen::AlignedBox3d> bounds; ///< input coordinates, after the transform; faces belong to it
    std::vector<bool> keep_classes;            ///< by number, 256 of them; empty: all
    double thin_spacing = 0;                   ///< one point stays in each cube of this edge; 0: all
    std::uint64_t every = 1;                   ///< of so many points, in the order of the files, the first stays
};

/// A set of the cells of a grid, with coordinates of 42 bits.
class CellSet {
public:
    /// False where it was in the set already.
    bool insert(std::int64_t x, std::int64_t y, std::int64_t z);
    std::uint64_t memory() const { return cells_.size() * sizeof(Cell); }

private:
    struct Cell {
        std::uint64_t low = 0, high = 0; ///< high is never 0 in a cell that is there
    };
    std::size_t placeOf(const Cell& cell) const;
    void grow();
    std::vector<Cell> cells_; ///< open addressing, at most half full
    std::size_t count_ = 0;
};

class PointFilter {
public:
    explicit PointFilter(FilterOptions options) : options_(std::move(options)) {}

    const FilterOptions& options() const { return options_; }
    /// Whether there is anything that it might not want.
    bool drops() const;
    bool choosesClasses() const { return !options_.keep_classes.empty(); }
    /// Points asked about so far; a filter that goes on where another one stopped is told of that one's.
    std::uint64_t seen() const { return seen_; }
    void goOnFrom(std::uint64_t seen) { seen_ = seen; }
    /// Whether the next point stays. point_class: 0 where the file has none
    bool keeps(const Vec3d& position, std::uint8_t point_class);

    /// Bytes that it takes, which grow with the cells of thinning that have a point.
    std::uint64_t memory() const { return cells_.memory(); }

private:
    bool isFirstOfCell(const Vec3d& position);

    FilterOptions options_;
    std::uint64_t seen_ = 0;
    CellSet cells_;
};

} // namespace pointrt
