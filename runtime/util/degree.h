// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace pointrt {

/// One degree in radians.
constexpr double kDegree = std::numbers::pi / 180;

} // namespace pointrt
