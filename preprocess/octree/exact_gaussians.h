// SPDX-License-Identifier: GPL-3.0-or-later
// Which Gaussians a file holds exactly besides their codes (section GEXA): those that look different after rounding.
#pragma once

#include <cstdint>

#include "pointrt/pro.h"

namespace pointrt {

/// Whether a Gaussian looks different after rounding: opacity off by more than a twentieth, or on the other side of the
/// least one that counts; or the end of an axis moved by more than 0.003 of the usual deviation.
/// @param usual_deviation the median of the longest deviations of the file's Gaussians, cube units
bool codesShow(const pro_exact_gaussian& exact, const pro_gaussian& decoded, double usual_deviation);

/// The parameters clamped to the range of the format: a rotation of unit length (the identity if it is not finite),
/// deviations whose squares are representable, an opacity of 0 to 1.
pro_exact_gaussian exactOf(const pro_gaussian& gaussian, std::uint32_t index);

} // namespace pointrt
