// SPDX-License-Identifier: GPL-3.0-or-later
// Selects points one by one while files are read, so that rejected points take no memory.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct FilterOptions {
    std::optional<Eigen::AlignedBox3d> bounds; ///< input coordinates, after the transform; closed
    std::vector<bool> keep_classes;            ///< 256 flags by class number; empty: all
    double thin_spacing = 0;                   ///< keep one point in each cube of this edge length; 0: all
    std::uint64_t every = 1;                   ///< keep one point of each run of this many, in the order of the files
};

/// A set of the cells of a grid, with coordinates of 42 bits.
class CellSet {
public:
    /// Returns false if the cell was in the set already.
    bool insert(std::int64_t x, std::int64_t y, std::int64_t z);
    std::uint64_t memory() const { return cells_.size() * sizeof(Cell); }

private:
    struct Cell {
        std::uint64_t low = 0, high = 0; ///< high is never 0 in an occupied place
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
    /// Whether it may reject points.
    bool drops() const {
        return options_.bounds || selectsClasses() || options_.thin_spacing > 0 || options_.every > 1;
    }
    bool selectsClasses() const { return !options_.keep_classes.empty(); }
    /// Points tested so far. A filter that continues the work of another resumes after its count.
    std::uint64_t seen() const { return seen_; }
    void resumeAfter(std::uint64_t seen) { seen_ = seen; }
    /// Whether to keep the next point. point_class: 0 if the file has no classes
    bool keeps(const Vec3d& position, std::uint8_t point_class);

    /// Memory in bytes, which grows with the number of occupied cells of thinning.
    std::uint64_t memory() const { return cells_.memory(); }

private:
    bool isFirstOfCell(const Vec3d& position);

    FilterOptions options_;
    std::uint64_t seen_ = 0;
    CellSet cells_;
};

} // namespace pointrt
