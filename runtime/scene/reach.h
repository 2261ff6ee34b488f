// SPDX-License-Identifier: Apache-2.0
// How far from a scene its cameras may stand.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// Whether what is seen from point still resolves a thousandth of the scene that has these bounds: within 10000 radii
/// of their sphere around its middle, where distances along rays, floats on the device, do. False where it is not
/// finite.
bool isWithinReach(Vec3 point, Vec3 bounds_min, Vec3 bounds_max);

} // namespace pointrt
