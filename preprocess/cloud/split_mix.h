// SPDX-License-Identifier: GPL-3.0-or-later
// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
#pragma once

#include <cstdint>

namespace pointrt {

/// One step from any state; decorrelates consecutive states.
constexpr std::uint64_t mixBits(std::uint64_t state) {
    state += 0x9E3779B97F4A7C15u;
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
    return state ^ (state >> 31);
}

/// The upper 53 bits as a number in [0, 1), a multiple of 2^-53.
constexpr double unitShare(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

} // namespace pointrt
