// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/trace_speed.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Weight of a new measurement in an estimate.
constexpr double kSlowdownWeight = 0.6, kSpeedupWeight = 0.3;
/// Resolutions are divided by powers of the fourth root of 2: two steps halve the area.
constexpr double kSizeStep = 1.189207115002721;
/// Largest reduction: coarser pictures are useless, however slow the tracer.
constexpr double kMaxDivisor = 16;
/// Fewest pixels to trace per frame: with fewer, the picture would hardly change.
constexpr double kMinPixels = 512;
/// Share of a frame's time that always goes to tracing.
constexpr double kMinTracedShare = 0.3;
/// A finer size must fit in this share of the time to be chosen again (hysteresis).
constexpr double kComfort = 0.75;

} // namespace

double smoothed(double estimate, double measured) {
    return estimate + (measured > estimate ? kSlowdownWeight : kSpeedupWeight) * (measured - estimate);
}

void TraceSpeed::addMeasurement(std::uint64_t pixels, double seconds) {
    if (pixels == 0 || !(seconds > 0)) return;
    const double measured = seconds / static_cast<double>(pixels);
    seconds_per_pixel_ = known_ ? smoothed(seconds_per_pixel_, measured) : measured;
    known_ = true;
}

std::uint32_t TraceSpeed::rowsFor(double seconds, std::uint32_t width) const {
    const double rows = seconds / (seconds_per_pixel_ * width);
    const double tiles = std::floor(rows / TILE_SIDE);
    return TILE_SIDE * static_cast<std::uint32_t>(std::clamp(tiles, 1.0, 1e6));
}

PixelSize TraceSpeed::previewSize(double seconds, PixelSize full, PixelSize last) const {
    const auto costs = [&](PixelSize size) { return secondsFor(std::uint64_t{size.width} * size.height); };
    double divisor = 1;
    PixelSize chosen = full;
    while (divisor < kMaxDivisor && costs(chosen) > seconds) {
        divisor *= kSizeStep;
        chosen = reduced(full, divisor);
    }
    const bool finer = std::uint64_t{chosen.width} * chosen.height > std::uint64_t{last.width} * last.height;
    const PixelSize before = reduced(full, divisor * kSizeStep);
    return finer && last == before && costs(chosen) > kComfort * seconds ? last : chosen;
}

double pixelsFor(double seconds, const ListCost& cost, double most) {
    const double traced_s = std::max(seconds - cost.other_s, kMinTracedShare * seconds);
    return std::clamp(traced_s / cost.seconds_per_pixel, std::min(kMinPixels, most), most);
}

PixelSize reduced(PixelSize full, double divisor) {
    const auto part = [&](std::uint32_t edge) {
        return std::max(1u, static_cast<std::uint32_t>(std::ceil(edge / divisor)));
    };
    return {part(full.width), part(full.height)};
}

} // namespace pointrt
