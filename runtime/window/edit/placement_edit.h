// SPDX-License-Identifier: Apache-2.0
// Edits of a scan's placement; render_space.h has where a point of it is placed.
#pragma once

#include "runtime/device_scene/render_space.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Turned about an axis (unit length, world) through a point of the scan, given in its own coordinates. Rounding is
/// kept from adding up: the rotation stays orthonormal.
Placement turned(const Placement& placement, Vec3 pivot, Vec3 axis, double degrees);

/// With another scale, above 0; the pivot stays in place.
Placement scaledTo(const Placement& placement, Vec3 pivot, double scale);

} // namespace pointrt
