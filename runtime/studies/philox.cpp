// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/philox.h"

#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// The middle of one of 2^52 intervals, so never 0 or 1; with the half it has the 53 bits of doubles just below 1.
double unitOf(std::uint32_t high, std::uint32_t low) {
    const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 12;
    return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

} // namespace

double LidarRandom::uniform(std::uint64_t pulse, LidarDraw what) const {
    const auto w = words(pulse, what, 0);
    return unitOf(w[0], w[1]);
}

double LidarRandom::gaussian(std::uint64_t pulse, LidarDraw what, std::uint32_t number) const {
    const auto w = words(pulse, what, number);
    return std::sqrt(-2 * std::log(unitOf(w[0], w[1]))) * std::cos(2 * std::numbers::pi * unitOf(w[2], w[3]));
}

} // namespace pointrt
