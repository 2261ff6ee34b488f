// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/philox.h"

#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// 53 bits, as many as a double tells apart below 1; the middle of its step, so that 0 and 1 are never met.
double unitOf(std::uint32_t high, std::uint32_t low) {
    const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 12; // 52: with the half there are 53
    return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

} // namespace

double LidarRandom::uniform(std::uint64_t pulse, LidarChance what) const {
    const auto w = words(pulse, what, 0);
    return unitOf(w[0], w[1]);
}

double LidarRandom::gaussian(std::uint64_t pulse, LidarChance what, std::uint32_t number) const {
    const auto w = words(pulse, what, number);
    return std::sqrt(-2 * std::log(unitOf(w[0], w[1]))) * std::cos(2 * std::numbers::pi * unitOf(w[2], w[3]));
}

} // namespace pointrt
