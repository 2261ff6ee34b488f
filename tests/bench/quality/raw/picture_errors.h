// SPDX-License-Identifier: Apache-2.0
// One picture against the truth, pixel by pixel.
#pragma once

#include "tests/bench/quality/raw/raw_points.h"
#include "tests/bench/quality/raw/sights.h"
#include "tests/bench/quality/statistics.h"

namespace pointrt::quality {

/// Counts of pixels.
struct PictureErrors {
    std::size_t truth = 0, picture = 0; ///< that hit something
    std::size_t both = 0, either = 0;   ///< of those
    std::size_t inside = 0, holes = 0;  ///< truth all around within kEdgePixels; nothing in the picture there
    std::size_t depth_off = 0;          ///< of both: further than the tolerance from the truth
    std::size_t false_surface = 0;      ///< of the picture: nearer than the truth by kFalseSpacings
    std::size_t floating = 0;           ///< of those: that far from any place of the mesh as well
    std::vector<float> normal_degrees;  ///< of both, without sign
};

/// This many spacings in front of the truth is where nothing is.
constexpr float kFalseSpacings = 3;
/// Pixels this near to the truth's outline count for the outline, not for holes.
constexpr int kEdgePixels = 3;

struct PictureTruth {
    const Tracing& tracing;
    const RawPoints& raw;
    float depth_tolerance; ///< unit frame
    float seen_reach;      ///< unit frame: what is further from any raw point nobody scanned
};

/// What is wrong with a pixel, the worst that is.
enum class PixelError : std::uint8_t {
    kNothingThere, ///< neither truth nor picture
    kRight,
    kDepthOff,
    kMissing,      ///< truth, no picture
    kExcess,       ///< picture, no truth
    kFalseSurface, ///< false_surface
    kFloating      ///< floating
};

/// All pixels, and without those whose truth is further than seen_reach from any raw point.
struct AllAndSeen {
    PictureErrors all, seen;
    std::vector<PixelError> pixels; ///< [size][size], rows downwards
};

AllAndSeen compareSights(const Sights& truth, const Sights& picture, const UnitCamera& camera,
                         const PictureTruth& against);

/// Writes a square picture of errors as PNG: grey what is right, cyan off in depth, yellow missing, blue excess,
/// magenta false surface, red floating. Throws Error (kCannotWrite).
void writeErrors(const std::string& path, const std::vector<PixelError>& pixels);

} // namespace pointrt::quality
