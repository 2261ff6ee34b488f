// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/placement_edit.h"

#include <numbers>

#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

/// placement with the pivot back at a place.
Placement heldAt(Placement placement, Vec3 pivot, Vec3 place) {
    placement.translation = placement.translation + (place - placed(placement, pivot));
    return placement;
}

} // namespace

Placement turned(const Placement& placement, Vec3 pivot, Vec3 axis, double degrees) {
    const double radians = degrees * std::numbers::pi / 180;
    const std::array<Vec3, 3>& r = placement.rotation;
    // the columns are the scan's axes in the world
    const Vec3 x = normalize(rotated({r[0].x, r[1].x, r[2].x}, axis, radians));
    const Vec3 rough = rotated({r[0].y, r[1].y, r[2].y}, axis, radians);
    const Vec3 y = normalize(rough - dot(rough, x) * x), z = cross(x, y);
    Placement next = placement;
    next.rotation = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
    return heldAt(next, pivot, placed(placement, pivot));
}

Placement scaledTo(const Placement& placement, Vec3 pivot, double scale) {
    Placement next = placement;
    next.scale = scale;
    return heldAt(next, pivot, placed(placement, pivot));
}

} // namespace pointrt
