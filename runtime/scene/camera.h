// SPDX-License-Identifier: Apache-2.0
// Completes cameras of which the user specifies only some properties, or none.
#pragma once

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Completes request for a scene with the given bounds (input units) and aspect (width over height, > 0).
///  - nothing given: the bounding sphere just fills the narrower field of view, seen from request.side with +Y up;
///  - parallel projection: the same position, moved back if part of the sphere would be behind the eye; without a
///    height the sphere just fills the narrower side of the picture;
///  - panorama: level, with the given up; eyes_apart is left at 0, as it needs the scene's unit;
///  - only eye: looks at the centre of the bounds;
///  - only target: same direction and distance as with nothing given;
///  - an up along the view direction (given or not) is replaced by -Z, or by +Y for a view along Z.
/// Throws Error kBadUsage if eye equals target, up is zero, fov_deg is outside [0.001, 180), ortho_height is outside
/// 1e-5 to 1e4 sphere radii, or eye or target is more than 1e4 radii away.
Camera frameCamera(const CameraRequest& request, Vec3 bounds_min, Vec3 bounds_max, double aspect);

/// Height in input units of the parallel picture whose narrower side the bounding sphere just fills.
double framingHeight(Vec3 bounds_min, Vec3 bounds_max, double aspect);

/// The default horizontal direction from the scene to the eye: +Z; -Z if Y points down; -Y if up is along Z. Unit
/// length, perpendicular to up, which may have any length but zero.
Vec3 frontSide(Vec3 up);

/// Half of the vertical field of view, in radians.
double verticalHalfAngle(double fov_deg);
double horizontalHalfAngle(double fov_deg, double aspect);

} // namespace pointrt
