// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/count_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "preprocess/cloud/split_mix.h"

namespace pointrt {
namespace {

constexpr int kAxisBits = 42;
constexpr std::int64_t kHalf = std::int64_t{1} << (kAxisBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kAxisBits) - 1;
/// A flag in Entry::high, above its 62 bits of the key.
constexpr std::uint64_t kThere = std::uint64_t{1} << 63;

/// The largest power of two not above a value.
double powerBelow(double value) { return std::ldexp(1.0, std::ilogb(value)); }

} // namespace

/// Cells start at a 4096th of the first batch's width, fine enough to split it, and only grow. Coordinates up to a
/// thousand times those of the batch still have separate cells.
void CountGrid::begin(const std::vector<Vec3d>& positions) {
    constexpr double kCells = 4096, kFarthest = 0x1p30;
    Eigen::AlignedBox3d box;
    for (const Vec3d& position : positions) box.extend(position);
    const double extent = box.sizes().maxCoeff();
    const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    const double edge = std::max({extent / kCells, farthest / kFarthest, 1e-30}); // 1e-30 if all coordinates are zero
    edge_ = powerBelow(edge);
    for (std::size_t axis = 0; axis < 3; ++axis)
        anchor_[axis] = static_cast<std::int64_t>(std::floor(positions.front()[Eigen::Index(axis)] / edge_));
    rehash(1024);
}

CountGrid::Entry CountGrid::keyOf(const GridCell& relative) const {
    std::array<std::uint64_t, 3> bits{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        bits[axis] = static_cast<std::uint64_t>(std::clamp(relative[axis], -kHalf, kHalf - 1)) & kMask;
    return {bits[0] | bits[1] << kAxisBits, bits[1] >> (64 - kAxisBits) | bits[2] << (2 * kAxisBits - 64) | kThere, 0};
}

CountGrid::Entry CountGrid::keyOf(const Vec3d& position) const {
    constexpr double kMost = 0x1p60; // far beyond what cells distinguish
    GridCell relative;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cell = std::clamp(std::floor(position[Eigen::Index(axis)] / edge_), -kMost, kMost);
        relative[axis] = static_cast<std::int64_t>(cell) - anchor_[axis];
    }
    return keyOf(relative);
}

GridCell CountGrid::relativeCellOf(const Entry& entry) const {
    const auto withSign = [](std::uint64_t bits) {
        return static_cast<std::int64_t>(bits << (64 - kAxisBits)) >> (64 - kAxisBits);
    };
    const std::uint64_t high = entry.high & ~kThere;
    return {withSign(entry.low & kMask), withSign((entry.low >> kAxisBits | high << (64 - kAxisBits)) & kMask),
            withSign(high >> (2 * kAxisBits - 64))};
}

/// Returns whether the cell is new.
bool CountGrid::insert(const Entry& key, std::uint64_t points) {
    const std::size_t mask = entries_.size() - 1;
    std::size_t place = mixBits(key.low ^ mixBits(key.high)) & mask;
    while (entries_[place].high != 0 && (entries_[place].low != key.low || entries_[place].high != key.high))
        place = (place + 1) & mask;
    Entry& entry = entries_[place];
    entry.points += points;
    if (entry.high != 0) return false;
    entry.low = key.low;
    entry.high = key.high;
    ++count_;
    return true;
}

void CountGrid::rehash(std::size_t capacity) {
    std::vector<Entry> before(capacity);
    before.swap(entries_);
    count_ = 0;
    for (const Entry& entry : before)
        if (entry.high != 0) insert(entry, entry.points);
}

/// Doubles the edge of all cells.
void CountGrid::coarsen() {
    std::vector<Entry> before(entries_.size());
    before.swap(entries_);
    count_ = 0;
    GridCell anchor;
    for (std::size_t axis = 0; axis < 3; ++axis) anchor[axis] = anchor_[axis] >> 1; // rounds down
    for (const Entry& entry : before) {
        if (entry.high == 0) continue;
        GridCell cell = relativeCellOf(entry);
        for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = ((cell[axis] + anchor_[axis]) >> 1) - anchor[axis];
        insert(keyOf(cell), entry.points);
    }
    anchor_ = anchor;
    edge_ *= 2;
}

void CountGrid::add(const std::vector<Vec3d>& positions, const std::function<void(std::size_t)>& on_new) {
    if (positions.empty()) return;
    if (edge_ == 0) begin(positions);
    const auto findKeys = [&](std::size_t from) {
        keys_.resize(positions.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(from, positions.size(), 4096), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) keys_[i] = keyOf(positions[i]);
        });
    };
    findKeys(0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!insert(keys_[i], 1)) continue;
        on_new(i);
        if (count_ > most_cells_) {
            while (count_ > most_cells_) coarsen();
            findKeys(i + 1);
        } else if (2 * (count_ + 1) > entries_.size()) {
            rehash(2 * entries_.size());
        }
    }
}

std::vector<CountedCell> CountGrid::cells() const {
    std::vector<CountedCell> cells;
    cells.reserve(count_);
    for (const Entry& entry : entries_) {
        if (entry.high == 0) continue;
        GridCell cell = relativeCellOf(entry);
        for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] += anchor_[axis];
        cells.push_back({cell, entry.points});
    }
    return cells;
}

} // namespace pointrt
