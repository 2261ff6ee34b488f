// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: independent of threads and of the order of calls.
#pragma once

#include <array>
#include <cstdint>

namespace pointrt {

/// Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3" (SC 2011). Results for
/// different counters are independent.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t kMultipliers[2] = {0xD2511F53, 0xCD9E8D57}; // from the paper, as are the steps of the key
    constexpr std::uint32_t kKeySteps[2] = {0x9E3779B9, 0xBB67AE85};    // golden ratio, sqrt(3) - 1
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = kMultipliers[0] * counter[0], b = kMultipliers[1] * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key = {key[0] + kKeySteps[0], key[1] + kKeySteps[1]};
    }
    return counter;
}

/// The uses of random numbers, which are independent streams.
enum class LidarDraw : std::uint32_t { kDrop, kFootprint, kRange };

/// The random numbers of one run.
class LidarRandom {
public:
    explicit LidarRandom(std::uint64_t seed)
        : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

    /// Uniform in (0, 1).
    double uniform(std::uint64_t pulse, LidarDraw what) const;
    /// Mean 0 and standard deviation 1, for one return of a pulse.
    double gaussian(std::uint64_t pulse, LidarDraw what, std::uint32_t number) const;

private:
    std::array<std::uint32_t, 4> words(std::uint64_t pulse, LidarDraw what, std::uint32_t number) const {
        return philox({static_cast<std::uint32_t>(pulse), static_cast<std::uint32_t>(pulse >> 32), number,
                       static_cast<std::uint32_t>(what)},
                      key_);
    }
    std::array<std::uint32_t, 2> key_;
};

} // namespace pointrt
