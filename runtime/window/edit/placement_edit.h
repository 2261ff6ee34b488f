// SPDX-License-Identifier: Apache-2.0
// Edits of a scan's placement.
#pragma once

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Turned about an axis (unit length, world) through a point of the scan, given in its own coordinates. Rounding is
/// kept from adding up: the rotation stays orthonormal.
Placement turned(const Placement& placement, Vec3 pivot, Vec3 axis, double degrees);

/// With another scale, above 0; the pivot stays in place.
Placement scaledTo(const Placement& placement, Vec3 pivot, double scale);

/// The place of a point of the scan in the world.
Vec3 placedPoint(const Placement& placement, Vec3 point);

} // namespace pointrt
