// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/clip_edit.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// The unit vector along an axis that is nearest to v.
Vec3 nearestClipAxis(Vec3 v) {
    const Vec3 size = absolute(v);
    const std::size_t axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
    Vec3 unit;
    coordinate(unit, axis) = coordinate(v, axis) < 0 ? -1 : 1;
    return unit;
}

} // namespace

double& coordinate(Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

ClipDescription newClipBox(Vec3 low, Vec3 high) {
    // a flat scan has no height: each edge is at least a thousandth of the diagonal
    const double least = std::max(1e-3 * length(high - low), 1e-9), half = least / 2;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (coordinate(high, axis) - coordinate(low, axis) >= least) continue;
        coordinate(low, axis) -= half;
        coordinate(high, axis) += half;
    }
    return {ClipBox{low, high}};
}

ClipDescription newClipPlane(const std::optional<ClipSurface>& picked, Vec3 forward, Vec3 middle, Vec3 up) {
    if (!picked) return {ClipPlane{middle, -1.0 * up}};
    const Vec3 axis = nearestClipAxis(picked->normal);
    return {ClipPlane{picked->position, dot(axis, forward) < 0 ? -1.0 * axis : axis}};
}

void setBoxSide(ClipBox& box, std::size_t axis, bool is_high, double value, double least) {
    Vec3& side = is_high ? box.high : box.low;
    const double other = coordinate(is_high ? box.low : box.high, axis);
    const double limited = is_high ? std::max(value, other + least) : std::min(value, other - least);
    // the box rotates about its centre, which moves by half of the step, along the rotated axis
    Vec3 half_way;
    coordinate(half_way, axis) = (limited - coordinate(side, axis)) / 2;
    const std::array<Vec3, 3>& r = box.rotation;
    const Vec3 turned{dot(r[0], half_way), dot(r[1], half_way), dot(r[2], half_way)};
    coordinate(side, axis) = limited;
    box.low = box.low + (turned - half_way);
    box.high = box.high + (turned - half_way);
}

} // namespace pointrt
