// SPDX-License-Identifier: Apache-2.0
// The largest distance of a camera from the scene.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// True if point is within 10000 radii of the bounding sphere's centre. Up to there ray distances, floats on the
/// device, resolve a thousandth of the scene's radius. False if point is not finite.
bool isWithinCameraRange(Vec3 point, Vec3 bounds_min, Vec3 bounds_max);

} // namespace pointrt
