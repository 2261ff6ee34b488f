// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/point_filter.h"

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/split_mix.h"

namespace pointrt {

std::size_t CellSet::placeOf(const Cell& cell) const {
    const std::size_t mask = cells_.size() - 1;
    std::size_t place = mixBits(cell.low ^ mixBits(cell.high)) & mask;
    while (cells_[place].high != 0 && (cells_[place].low != cell.low || cells_[place].high != cell.high))
        place = (place + 1) & mask;
    return place;
}

void CellSet::grow() {
    std::vector<Cell> before(std::max<std::size_t>(1024, 2 * cells_.size()));
    before.swap(cells_);
    for (const Cell& cell : before)
        if (cell.high != 0) cells_[placeOf(cell)] = cell;
}

bool CellSet::insert(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 42) - 1;
    const std::uint64_t ux = static_cast<std::uint64_t>(x) & kMask, uy = static_cast<std::uint64_t>(y) & kMask,
                        uz = static_cast<std::uint64_t>(z) & kMask;
    const Cell cell{ux | uy << 42, uy >> 22 | uz << 20 | std::uint64_t{1} << 63};
    if (2 * (count_ + 1) > cells_.size()) grow();
    Cell& place = cells_[placeOf(cell)];
    if (place.high != 0) return false;
    place = cell;
    ++count_;
    return true;
}

bool PointFilter::isFirstOfCell(const Vec3d& position) {
    constexpr double kMost = 0x1p41; // in cells from zero; points beyond share the last cell
    const Vec3d cell = (position / options_.thin_spacing).array().floor().max(-kMost).min(kMost - 1);
    const Eigen::Matrix<std::int64_t, 3, 1> index = cell.cast<std::int64_t>();
    return cells_.insert(index.x(), index.y(), index.z());
}

bool PointFilter::keeps(const Vec3d& position, std::uint8_t point_class) {
    if (seen_++ % options_.every != 0) return false;
    if (options_.bounds && !options_.bounds->contains(position)) return false;
    if (selectsClasses() && !options_.keep_classes[point_class]) return false;
    return options_.thin_spacing <= 0 || isFirstOfCell(position);
}

} // namespace pointrt
