// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/sightline_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointrt::surface {
namespace {

/// A direction's intersection with the cube of half edge 1.
struct Place {
    int side; ///< twice the axis, plus 1 where it is negative
    float u, v;
};

Place placeOf(const Vec3f& direction) {
    int axis;
    const float reach = direction.cwiseAbs().maxCoeff(&axis);
    return {2 * axis + (direction[axis] < 0), direction[(axis + 1) % 3] / reach, direction[(axis + 2) % 3] / reach};
}

/// Range of a / b over ranges of a and b, with b above 0.
SlopeRange quotient(const SlopeRange& a, const SlopeRange& b) {
    return {a.least / (a.least < 0 ? b.least : b.most), a.most / (a.most < 0 ? b.most : b.least)};
}

} // namespace

SightlineMap::SightlineMap(const std::vector<Vec3f>& seen) {
    std::array<Eigen::AlignedBox2f, 6> boxes;
    std::size_t count = 0;
    for (const Vec3f& each : seen) {
        if (each.isZero()) continue;
        const Place place = placeOf(each);
        boxes[std::size_t(place.side)].extend(Eigen::Vector2f(place.u, place.v));
        ++count;
    }
    layOut(boxes, count);
    sort(seen, count);
}

void SightlineMap::layOut(const std::array<Eigen::AlignedBox2f, 6>& boxes, std::size_t count) {
    constexpr double kPointsPerCell = 2;
    double area = 0;
    for (const auto& box : boxes)
        if (!box.isEmpty()) area += double(box.sizes().x()) * double(box.sizes().y());
    // Directions along a line have no area: limits the cells in a row to the points, and to what float resolves.
    const double wanted = std::sqrt(double(count) / (kPointsPerCell * std::max(area, 1e-12)));
    cells_per_unit_ = float(std::clamp(wanted, 1.0, std::min(double(1 << 14), 1.0 + double(count))));
    std::size_t cells = 0;
    for (std::size_t side = 0; side < 6; ++side) {
        if (boxes[side].isEmpty()) continue;
        const Eigen::Vector2f sizes = boxes[side].sizes() * cells_per_unit_;
        faces_[side] = {boxes[side].min().x(), boxes[side].min().y(), int(sizes.x()) + 1, int(sizes.y()) + 1, cells};
        cells += std::size_t(faces_[side].columns) * std::size_t(faces_[side].rows);
    }
    first_.assign(cells + 1, 0);
}

std::size_t SightlineMap::cellOf(const Vec3f& seen) const {
    const Place place = placeOf(seen);
    const Face& face = faces_[std::size_t(place.side)];
    const int column = std::min(int((place.u - face.least_u) * cells_per_unit_), face.columns - 1);
    const int row = std::min(int((place.v - face.least_v) * cells_per_unit_), face.rows - 1);
    return face.first_cell + std::size_t(row) * std::size_t(face.columns) + std::size_t(column);
}

void SightlineMap::sort(const std::vector<Vec3f>& seen, std::size_t count) {
    for (const Vec3f& each : seen)
        if (!each.isZero()) ++first_[cellOf(each) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    seen_.resize(count);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Vec3f& each : seen)
        if (!each.isZero()) seen_[next[cellOf(each)]++] = each;
}

SlopeRange SightlineMap::cellsOf(const SlopeRange& places, float least) const {
    return {(places.least - least) * cells_per_unit_, (places.most - least) * cells_per_unit_};
}

SightlineMap::Range SightlineMap::rangeOf(int side, const Eigen::AlignedBox3f& box) const {
    const Face& face = faces_[std::size_t(side)];
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool negative = side % 2;
    const SlopeRange ahead =
        negative ? SlopeRange{-box.max()[axis], -box.min()[axis]} : SlopeRange{box.min()[axis], box.max()[axis]};
    if (!(ahead.least > 0)) return {};
    const SlopeRange columns = cellsOf(quotient({box.min()[u], box.max()[u]}, ahead), face.least_u);
    const SlopeRange rows = cellsOf(quotient({box.min()[v], box.max()[v]}, ahead), face.least_v);
    if (columns.most < 0 || rows.most < 0 || columns.least >= float(face.columns) || rows.least >= float(face.rows))
        return {};
    return {int(std::max(rows.least, 0.0f)), int(std::min(rows.most, float(face.rows - 1))),
            int(std::max(columns.least, 0.0f)), int(std::min(columns.most, float(face.columns - 1)))};
}

} // namespace pointrt::surface
