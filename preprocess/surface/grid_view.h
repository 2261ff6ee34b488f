// SPDX-License-Identifier: GPL-3.0-or-later
// Access to a range grid by row and column, also outside its frame.
#pragma once

#include <cstdint>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// An offset in rows and columns.
struct GridStep {
    std::int64_t rows = 0, columns = 0;
};

constexpr GridStep operator*(int times, GridStep step) { return {times * step.rows, times * step.columns}; }

struct GridCell {
    std::int64_t row = 0, column = 0;
};

constexpr GridCell operator+(GridCell cell, GridStep step) {
    return {cell.row + step.rows, cell.column + step.columns};
}

/// A grid of a cloud. Both must outlive it.
struct GridView {
    const Cloud& cloud;
    const RangeGrid& grid;

    /// The point in a cell, kNoPoint or kFilteredOut; kFilteredOut outside the frame, where nothing is known.
    std::uint32_t at(GridCell cell) const {
        const std::int64_t columns = grid.columns;
        if (grid.wraps) cell.column = (cell.column % columns + columns) % columns;
        const bool inside = cell.row >= 0 && cell.row < grid.rows && cell.column >= 0 && cell.column < columns;
        return inside ? grid.at(std::uint32_t(cell.row), std::uint32_t(cell.column)) : RangeGrid::kFilteredOut;
    }

    /// Relative to the cloud's origin.
    Vec3d position(std::uint32_t point) const { return cloud.positions[point].cast<double>(); }
};

} // namespace pointrt
