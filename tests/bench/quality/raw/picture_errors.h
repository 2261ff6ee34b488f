// SPDX-License-Identifier: Apache-2.0
// Compares a picture with the truth, pixel by pixel.
#pragma once

#include "tests/bench/quality/raw/raw_points.h"
#include "tests/bench/quality/raw/sights.h"
#include "tests/bench/quality/statistics.h"

namespace pointrt::quality {

/// Counts of pixels.
struct PictureErrors {
    std::size_t truth = 0, picture = 0; ///< with a hit
    std::size_t both = 0, either = 0;   ///< with hits in both, in either
    std::size_t inside = 0, holes = 0;  ///< truth everywhere within kEdgePixels; of those, no hit in the picture
    std::size_t depth_off = 0;          ///< of both: depth differs by more than the tolerance
    std::size_t false_surface = 0;      ///< of the picture: nearer than the truth by kFalseSpacings
    std::size_t floating = 0;           ///< of those: also that far from any part of the mesh
    std::vector<float> normal_degrees;  ///< of both, unsigned
};

/// A surface this many spacings in front of the truth is an error.
constexpr float kFalseSpacings = 3;
/// Pixels this near to the truth's silhouette do not count as holes.
constexpr int kEdgePixels = 3;

struct PictureTruth {
    const Tracing& tracing;
    const RawPoints& raw;
    float depth_tolerance; ///< unit frame
    float seen_reach;      ///< unit frame: truth further than this from all raw points was not scanned
};

/// The worst error of a pixel.
enum class PixelError : std::uint8_t {
    kNothingThere, ///< neither truth nor picture
    kRight,
    kDepthOff,
    kMissing,      ///< truth, no picture
    kExcess,       ///< picture, no truth
    kFalseSurface, ///< false_surface
    kFloating      ///< floating
};

/// Errors of all pixels, and of those whose truth is within seen_reach of a raw point.
struct AllAndSeen {
    PictureErrors all, seen;
    std::vector<PixelError> pixels; ///< [size][size], rows go down
};

AllAndSeen compareSights(const Sights& truth, const Sights& picture, const UnitCamera& camera,
                         const PictureTruth& against);

/// Writes a square picture of errors as PNG: grey correct, cyan off in depth, yellow missing, blue excess, magenta
/// false surface, red floating. Throws Error (kCannotWrite).
void writeErrors(const std::string& path, const std::vector<PixelError>& pixels);

} // namespace pointrt::quality
