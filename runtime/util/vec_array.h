// SPDX-License-Identifier: Apache-2.0
// Vectors as the arrays of public interfaces, and back.
#pragma once

#include <array>

#include "runtime/util/vec.h"

namespace pointrt {

inline Vec3 vectorOf(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }
inline std::array<double, 3> arrayOf(Vec3 vector) { return {vector.x, vector.y, vector.z}; }

} // namespace pointrt
