// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/placement_edit.h"

#include <numbers>

#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

/// placement, shifted so that the pivot is at a place.
Placement heldAt(Placement placement, Vec3 pivot, Vec3 place) {
    placement.translation = placement.translation + (place - placed(placement, pivot));
    return placement;
}

} // namespace

Placement turned(const Placement& placement, Vec3 pivot, Vec3 axis, double degrees) {
    const double radians = degrees * std::numbers::pi / 180;
    Placement next = placement;
    next.rotation = turnedColumns(placement.rotation, [&](Vec3& v) { v = rotated(v, axis, radians); });
    return heldAt(next, pivot, placed(placement, pivot));
}

Placement scaledTo(const Placement& placement, Vec3 pivot, double scale) {
    Placement next = placement;
    next.scale = scale;
    return heldAt(next, pivot, placed(placement, pivot));
}

} // namespace pointrt
