// SPDX-License-Identifier: Apache-2.0
// Random numbers that do not depend on the order of calls.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pointrt::quality {

/// splitmix64 (Steele et al. 2014), a sequence for each (seed, stream): one stream per ray, for any thread.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed * 0x9E3779B97F4A7C15u) {
        state_ = next() + stream * 0xD1B54A32D192ED03u;
        next();
    }
    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    /// Standard normal (Box and Muller 1958).
    double normal() { return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * std::numbers::pi * uniform()); }

private:
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
        z = (z ^ z >> 27) * 0x94D049BB133111EBu;
        return z ^ z >> 31;
    }

    std::uint64_t state_;
};

} // namespace pointrt::quality
