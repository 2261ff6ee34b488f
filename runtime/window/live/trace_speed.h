// SPDX-License-Identifier: Apache-2.0
// How much of a picture can be traced in a given time, learnt from what was traced before.
#pragma once

#include <cstdint>

#include "runtime/util/pixel_size.h"

namespace pointrt {

/// The speed of the tracer on the scene as it is seen.
class TraceSpeed {
public:
    /// So many pixels took that long, for a sample each.
    void addMeasurement(std::uint64_t pixels, double seconds);

    /// From here on a pixel takes so many times as long: the scene has become another one.
    void scaleCost(double times) { seconds_per_pixel_ *= times; }

    /// Seconds for a sample of so many pixels.
    double secondsFor(std::uint64_t pixels) const { return static_cast<double>(pixels) * seconds_per_pixel_; }

    /// Rows of a picture so many pixels wide that fit in the time: a multiple of the tracer's tiles, at least one tile.
    std::uint32_t rowsFor(double seconds, std::uint32_t width) const;

    /// The size, of the same shape as full, in which a whole picture fits in the time. It keeps to last, the size that
    /// was chosen before, as long as that is nearly right: a picture that changes its grain at every frame flickers.
    PixelSize previewSize(double seconds, PixelSize full, PixelSize last) const;

private:
    double seconds_per_pixel_ = 1e-6; ///< a first guess: two cores on a scan of a million points
    bool known_ = false;
};

/// full divided by divisor (1 or more), rounded up.
PixelSize reduced(PixelSize full, double divisor);

} // namespace pointrt
