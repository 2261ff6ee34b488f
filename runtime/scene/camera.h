// SPDX-License-Identifier: Apache-2.0
// Where the camera stands when the user says little or nothing.
#pragma once

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Completes request for a scene with the given bounds (input units) and aspect (width over height, > 0).
///  - nothing given: the bounds' sphere just fills the narrower field of view, seen from request.side with +Y up;
///  - parallel projection: the same place, but never with a part of the sphere behind the eye; without a height the
///    sphere just fills the picture's narrower side;
///  - only eye: looks at the centre of the bounds;
///  - only target: keeps that direction and distance;
///  - an up along the view direction (given or not) is replaced by -Z, or +Y for a view along Z.
/// Throws Error kBadUsage: eye equal to target, a zero up, fov_deg outside (0, 180), an ortho_height outside 1e-5 to
/// 1e4 of the sphere's radius.
Camera frameCamera(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, double aspect);

/// Height, in input units, of the parallel picture whose narrower side the sphere around the bounds just fills.
double framingHeight(Vec3 bounds_min, Vec3 bounds_max, double aspect);

/// The horizontal direction that scenes are looked at from where nothing is said: +Z, or -Y where up is along Z. Unit
/// length, at right angles to up, which may be of any length but zero.
Vec3 frontSide(Vec3 up);

/// Half angles of the view in radians.
double verticalHalfAngle(double fov_deg);
double horizontalHalfAngle(double fov_deg, double aspect);

} // namespace pointrt
