// SPDX-License-Identifier: Apache-2.0
// Edits of a scan's placement. render_space.h applies placements to points.
#pragma once

#include <array>

#include "runtime/device_scene/render_space.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// A rotation, as orthonormal rows, after turn(column) has rotated its columns in the world. Keeps rounding errors from
/// adding up.
template <typename Turn>
std::array<Vec3, 3> turnedColumns(const std::array<Vec3, 3>& rows, const Turn& turn) {
    Vec3 x{rows[0].x, rows[1].x, rows[2].x}, rough{rows[0].y, rows[1].y, rows[2].y};
    turn(x);
    turn(rough);
    x = normalize(x);
    const Vec3 y = normalize(rough - dot(rough, x) * x), z = cross(x, y);
    return {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
}

/// placement rotated about an axis (unit length, world) through a point of the scan, given in the scan's coordinates.
Placement turned(const Placement& placement, Vec3 pivot, Vec3 axis, double degrees);

/// placement with another scale, above 0; the pivot stays in place.
Placement scaledTo(const Placement& placement, Vec3 pivot, double scale);

} // namespace pointrt
