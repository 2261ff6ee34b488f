// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/pattern.h"

#include <cmath>
#include <numbers>

#include "runtime/util/degree.h"

namespace pointrt {
namespace {

Vec3 directionOf(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * kDegree, elevation = elevation_deg * kDegree;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// Degrees modulo 360 after this many steps.
double turned(std::uint64_t number, double step_deg) { return std::fmod(static_cast<double>(number) * step_deg, 360); }

FiringTimes timesOf(const LidarSpinning& spinning) {
    const double turn_s = 1 / spinning.rotation_hz;
    return {turn_s * spinning.step_deg / 360, spinning.elevations_deg.size(), turn_s};
}
FiringTimes timesOf(const LidarFlash& flash) {
    return {1 / flash.frame_hz, std::uint64_t{flash.width} * flash.height, 1 / flash.frame_hz};
}
FiringTimes timesOf(const LidarOscillating& mirror) { return {1 / mirror.pulse_hz, 1, 1 / mirror.scan_hz}; }
FiringTimes timesOf(const LidarTable& table) { return {1 / table.repeat_hz, table.beams.size(), 1 / table.repeat_hz}; }

LidarPulse pulseIn(const LidarSpinning& spinning, std::uint64_t period, std::uint64_t beam) {
    const double turn = turned(period, spinning.step_deg);
    const double azimuth = spinning.start_deg + (spinning.clockwise ? -turn : turn);
    return {0, directionOf(azimuth, spinning.elevations_deg[beam]), static_cast<std::uint16_t>(beam), 0};
}

LidarPulse pulseIn(const LidarFlash& flash, std::uint64_t, std::uint64_t pixel) {
    const std::uint64_t column = pixel % flash.width, row = pixel / flash.width;
    // 1 at the left and upper edge of the frame, -1 at the right and lower one
    const auto across = [](std::uint64_t place, std::uint32_t count) {
        return 1 - (2 * static_cast<double>(place) + 1) / count;
    };
    const double left = across(column, flash.width) * std::tan(flash.width_deg / 2 * kDegree);
    const double up = across(row, flash.height) * std::tan(flash.height_deg / 2 * kDegree);
    return {0, normalize({1, left, up}), static_cast<std::uint16_t>(row), 0};
}

/// A swing from -1 to 1 and back per cycle.
double swing(double cycles, bool sinusoidal) {
    const double phase = cycles - std::floor(cycles);
    if (sinusoidal) return -std::cos(2 * std::numbers::pi * phase);
    return phase < 0.5 ? 4 * phase - 1 : 3 - 4 * phase;
}

LidarPulse pulseIn(const LidarOscillating& mirror, std::uint64_t period, std::uint64_t) {
    const double cycles = static_cast<double>(period) * (mirror.scan_hz / mirror.pulse_hz);
    const double angle_deg = mirror.field_of_view_deg / 2 * swing(cycles, mirror.sinusoidal);
    const double angle = angle_deg * kDegree; // to the right, which is -y
    return {0, {0, -std::sin(angle), -std::cos(angle)}, 0, static_cast<float>(angle_deg)};
}

LidarPulse pulseIn(const LidarTable& table, std::uint64_t, std::uint64_t number) {
    const LidarBeam& beam = table.beams[number];
    return {beam.delay_s, directionOf(beam.azimuth_deg, beam.elevation_deg), beam.ring, 0};
}

} // namespace

FiringTimes firingTimes(const LidarPattern& pattern) {
    return std::visit([](const auto& kind) { return timesOf(kind); }, pattern);
}

LidarPulse pulseOf(const LidarPattern& pattern, std::uint64_t number) {
    const FiringTimes times = firingTimes(pattern);
    const std::uint64_t period = number / times.pulses;
    LidarPulse pulse =
        std::visit([&](const auto& kind) { return pulseIn(kind, period, number % times.pulses); }, pattern);
    pulse.delay_s += static_cast<double>(period) * times.period_s;
    return pulse;
}

} // namespace pointrt
