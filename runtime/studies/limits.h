// SPDX-License-Identifier: Apache-2.0
// What numbers of a sensor may be, whether they come from a file or from a program; ends included.
#pragma once

#include <cstdint>

namespace pointrt {

struct LidarLimit {
    double low, high;
};

// Times and angles of any pulse stay well within what doubles count.
constexpr LidarLimit kLidarRates{1e-6, 1e9};      // Hz: a turn in eleven days, a pulse a nanosecond
constexpr LidarLimit kLidarSteps{1e-6, 360};      // degrees
constexpr LidarLimit kLidarElevations{-90, 90};   // degrees
constexpr LidarLimit kLidarAngles{-36000, 36000}; // degrees: a hundred turns
constexpr LidarLimit kLidarFields{1e-3, 179.999}; // degrees: tangents of the half stay numbers
constexpr LidarLimit kLidarDelays{0, 1e6};        // seconds
constexpr LidarLimit kLidarLengths{0, 1e9};       // metres: farther than the moon
constexpr LidarLimit kLidarSomeLengths{1e-6, 1e9};
constexpr LidarLimit kLidarDivergences{0, 1000}; // milliradians
constexpr LidarLimit kLidarShares{0, 1};
constexpr LidarLimit kLidarNumbers{0, 1e12};
constexpr LidarLimit kLidarSomeNumbers{1e-12, 1e12};
constexpr LidarLimit kLidarUnits{1e-9, 1e9}; // metres

constexpr std::uint32_t kMaxLidarPixels = 65536; // of a side: rows are rings, which have 16 bits
constexpr std::uint32_t kMaxLidarRings = 65536;
constexpr std::uint32_t kMaxLidarBeams = 1u << 24; // of a table
constexpr std::uint32_t kMaxLidarRays = 4096;      // of a beam: a share of it is told to 1/4096
constexpr std::uint32_t kMaxLidarReturns = 15;     // of a pulse, as many as LAS 1.4 numbers

} // namespace pointrt
