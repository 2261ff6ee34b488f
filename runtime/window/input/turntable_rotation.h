// SPDX-License-Identifier: Apache-2.0
// Directions of view as two angles about an axis: no roll.
#pragma once

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// up with the same direction, and a length whose square neither overflows nor vanishes; most are left as they are.
Vec3 usableAxis(Vec3 up);

struct Attitude {
    Vec3 right;           ///< unit, at right angles to the axis
    double elevation = 0; ///< radians that the view looks up from the horizon
};

Attitude attitudeOf(const ViewCamera& view);
/// Unit direction of view about the unit axis.
Vec3 forwardOf(const Attitude& attitude, Vec3 axis);
/// v turned about the unit axis, counterclockwise seen with the axis pointing at you.
Vec3 rotated(Vec3 v, Vec3 axis, double radians);

/// view with its eye at distance from pivot in direction attitude.
ViewCamera placed(ViewCamera view, Vec3 pivot, double distance, const Attitude& attitude);

} // namespace pointrt
