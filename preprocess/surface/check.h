// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that points span a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

/// Throws Error (kBadInput) if there are fewer than 3 positions, or all are equal or on one line to within a millionth
/// of their extent (and the rounding of float). Ignores up to a hundredth of the points as distant outliers. The
/// message is the reason without a file's name. Returns the indices, ascending, of extreme outliers (hardly ever any):
/// 2^60 times the extent of the others away, so that at their scale, floats cannot distinguish the others.
std::vector<std::uint32_t> requireSurface(const std::vector<Vec3f>& positions);

} // namespace pointrt::surface
