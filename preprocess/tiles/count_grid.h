// SPDX-License-Identifier: GPL-3.0-or-later
// Counts points on a sparse grid whose cells grow as more of them are occupied: as fine as the memory allows, whatever
// the extent, and the same for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Index of a cell along each axis: floor(coordinate / edge).
using GridCell = std::array<std::int64_t, 3>;

struct CountedCell {
    GridCell cell{};
    std::uint64_t points = 0;
};

class CountGrid {
public:
    /// most_cells: at least 8; each takes 48 to 96 bytes
    explicit CountGrid(std::size_t most_cells) : most_cells_(most_cells) {}

    /// Counts the points of a batch in parallel. Calls on_new, in order, with each point that is the first of its cell.
    void add(const std::vector<Vec3d>& positions, const std::function<void(std::size_t)>& on_new);

    /// Edge of a cell, input units: a power of two; 0 before the first point.
    double edge() const { return edge_; }
    std::size_t cellCount() const { return count_; }
    std::vector<CountedCell> cells() const; ///< in unspecified order

private:
    /// A cell relative to the anchor, 42 bits per axis.
    struct Entry {
        std::uint64_t low = 0, high = 0; ///< high is never 0 in an occupied entry
        std::uint64_t points = 0;
    };
    void begin(const std::vector<Vec3d>& positions);
    Entry keyOf(const Vec3d& position) const;
    Entry keyOf(const GridCell& relative) const;
    GridCell relativeCellOf(const Entry& entry) const;
    bool insert(const Entry& key, std::uint64_t points);
    void rehash(std::size_t capacity);
    void coarsen();

    std::size_t most_cells_, count_ = 0;
    double edge_ = 0;
    GridCell anchor_{};          ///< origin of relative cells
    std::vector<Entry> entries_; ///< open addressing, at most half full
    std::vector<Entry> keys_;    ///< of the current batch
};

} // namespace pointrt
