// SPDX-License-Identifier: Apache-2.0
// The order of the spherical harmonics of Gaussians: three of degree 1, five of degree 2, seven of degree 3.
#pragma once

#include <cstdint>

namespace pointrt {

/// The degree of a coefficient, 1 to 3. @param coefficient 0 to 14, without the constant one
constexpr std::uint32_t degreeOfHarmonic(std::uint32_t coefficient) {
    return coefficient < 3 ? 1 : coefficient < 8 ? 2 : 3; // degree d ends with coefficient (d + 1)^2 - 2
}

} // namespace pointrt
