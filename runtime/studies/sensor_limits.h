// SPDX-License-Identifier: Apache-2.0
// Ranges of the numbers of a sensor, for files and programs alike. Both ends are included.
#pragma once

#include <cstdint>

namespace pointrt {

struct LidarLimit {
    double low, high;
};

// They keep the times and angles of every pulse well within the precision of doubles.
constexpr LidarLimit kLidarRates{1e-6, 1e9};      // Hz: a rotation in 11 days to a pulse each nanosecond
constexpr LidarLimit kLidarSteps{1e-6, 360};      // degrees
constexpr LidarLimit kLidarElevations{-90, 90};   // degrees
constexpr LidarLimit kLidarAngles{-36000, 36000}; // degrees: a hundred rotations
constexpr LidarLimit kLidarFields{1e-3, 179.999}; // degrees, so that tangents of half of it stay finite
constexpr LidarLimit kLidarDelays{0, 1e6};        // seconds
constexpr LidarLimit kLidarLengths{0, 1e9};       // metres: farther than the moon
constexpr LidarLimit kLidarSomeLengths{1e-6, 1e9};
constexpr LidarLimit kLidarDivergences{0, 1000}; // milliradians
constexpr LidarLimit kLidarShares{0, 1};
constexpr LidarLimit kLidarNumbers{0, 1e12};
constexpr LidarLimit kLidarSomeNumbers{1e-12, 1e12};
constexpr LidarLimit kLidarUnits{1e-9, 1e9}; // metres

constexpr std::uint32_t kMaxLidarPixels = 65536; // per side, since rows are rings, which have 16 bits
constexpr std::uint32_t kMaxLidarRings = 65536;
constexpr std::uint32_t kMaxLidarBeams = 1u << 24; // of a table
constexpr std::uint32_t kMaxLidarRays = 4096;      // per beam
constexpr std::uint32_t kMaxLidarReturns = 15;     // per pulse, as in LAS 1.4

} // namespace pointrt
