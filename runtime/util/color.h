// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace pointrt {

/// Linear RGB: reflectance in [0, 1], or light of at least 0.
using Color = std::array<float, 3>;

} // namespace pointrt
