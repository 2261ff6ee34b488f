// SPDX-License-Identifier: Apache-2.0
// Estimates the tracer's speed, and from it how much of a picture fits in a given time.
#pragma once

#include <cstdint>

#include "runtime/util/pixel_size.h"

namespace pointrt {

/// The estimate of a duration after a measurement. A higher one gets more weight than a lower one: a late frame is
/// worse than a coarse one.
double smoothed(double estimate, double measured);

/// The tracer's speed for the current view.
class TraceSpeed {
public:
    /// Records that tracing one sample of each of this many pixels took this long.
    void addMeasurement(std::uint64_t pixels, double seconds);

    /// Whether anything has been measured.
    bool isKnown() const { return known_; }

    /// Call it when the cost of a pixel has changed by this factor because the scene has changed.
    void scaleCost(double times) { seconds_per_pixel_ *= times; }

    /// Predicted seconds for one sample of each of this many pixels.
    double secondsFor(std::uint64_t pixels) const { return static_cast<double>(pixels) * seconds_per_pixel_; }

    /// Rows of this width that fit in the time: a multiple of TILE_SIDE, at least one row of tiles.
    std::uint32_t rowsFor(double seconds, std::uint32_t width) const;

    /// The largest size with full's aspect ratio that fits in the time. Keeps last, the previous choice, while it is
    /// nearly right: a resolution that changes with every frame flickers.
    PixelSize previewSize(double seconds, PixelSize full, PixelSize last) const;

private:
    double seconds_per_pixel_ = 1e-6; ///< initial guess: two cores, a million splats
    bool known_ = false;
};

/// The cost of tracing pixels as a short list rather than a picture.
struct ListCost {
    double other_s = 0.01;           ///< seconds of a frame besides tracing; initial guess
    double seconds_per_pixel = 1e-6; ///< of recent lists; initial guess: two cores, a million splats
};

/// The number of listed pixels that fit in a frame of this many seconds, between a minimum and most.
double pixelsFor(double seconds, const ListCost& cost, double most);

/// full / divisor (at least 1), rounded up.
PixelSize reduced(PixelSize full, double divisor);

} // namespace pointrt
