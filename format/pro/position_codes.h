// SPDX-License-Identifier: Apache-2.0
// The position of a splat in SPLT.
#pragma once

#include <array>
#include <cstdint>

#include "pointrt/pro_layout.h"

namespace pointrt::format {

/// Position codes x, y and z of the words of a splat.
inline std::array<std::uint32_t, 3> positionCodes(const std::uint32_t words[4]) {
    const std::uint32_t y = words[0] >> PRO_POSITION_BITS | (words[1] & PRO_Y_HIGH_MASK) << PRO_Y_LOW_BITS;
    return {words[0] & PRO_POSITION_MASK, y, words[1] >> PRO_Y_HIGH_BITS & PRO_POSITION_MASK};
}

} // namespace pointrt::format
