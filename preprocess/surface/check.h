// SPDX-License-Identifier: GPL-3.0-or-later
// Do these points span a surface at all?
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

/// Throws Error (kBadInput) when there are fewer than 3 positions, or all are equal or lie on one line to within
/// a millionth of their extent (and the rounding of float). A hundredth of the points may be strays too far away to
/// matter for that. The message is the reason without a file's name.
/// Returns, ascending, strays beyond all proportion, of which there are hardly ever any: 2^60 times as far off as the
/// others reach, so that floats that hold them cannot tell the others apart.
std::vector<std::uint32_t> requireSurface(const std::vector<Vec3f>& positions);

} // namespace pointrt::surface
