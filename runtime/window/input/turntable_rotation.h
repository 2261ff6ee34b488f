// SPDX-License-Identifier: Apache-2.0
// Turntable rotation: view directions as two angles about an axis, without roll.
#pragma once

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// up with its length normalised if its square would overflow or underflow; otherwise unchanged.
Vec3 usableAxis(Vec3 up);

struct Attitude {
    Vec3 right;           ///< unit length, perpendicular to the axis
    double elevation = 0; ///< of the view direction above the horizon, radians
};

Attitude attitudeOf(const ViewCamera& view);
/// View direction (unit length) about the unit axis.
Vec3 forwardOf(const Attitude& attitude, Vec3 axis);
/// v rotated about the unit axis, counterclockwise when the axis points at the viewer.
Vec3 rotated(Vec3 v, Vec3 axis, double radians);

/// view with this pivot, its eye at this distance from the pivot, and the view direction of attitude.
ViewCamera placed(ViewCamera view, Vec3 pivot, double distance, const Attitude& attitude);

} // namespace pointrt
