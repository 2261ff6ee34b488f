// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/raw/picture_errors.h"

#include <array>
#include <cmath>
#include <tbb/parallel_for.h>

#include "runtime/image/image_png.h"
#include "tests/bench/quality/angles.h"

namespace pointrt::quality {

namespace {

/// Results of the searches for a pixel.
struct Judgement {
    bool seen = true, false_surface = false, floating = false;
};

Judgement judge(const Sight& truth, const Sight& picture, std::size_t pixel, const UnitCamera& camera,
                const PictureTruth& against) {
    Judgement judgement;
    if (truth.hit()) judgement.seen = against.raw.isSampled(camera.place(pixel, truth.t), against.seen_reach);
    if (!picture.hit() || picture.t >= truth.t) return judgement;
    const Vec3f place = camera.place(pixel, picture.t);
    const float limit = kFalseSpacings * against.raw.spacingAt(truth.hit() ? camera.place(pixel, truth.t) : place);
    judgement.false_surface = truth.t - picture.t > limit;
    judgement.floating = judgement.false_surface && against.tracing.distanceWithin(place, limit) >= limit;
    return judgement;
}

/// Whether the truth is hit everywhere within kEdgePixels of a pixel.
bool isInside(const Sights& truth, std::size_t pixel, int size) {
    const int row = static_cast<int>(pixel) / size, column = static_cast<int>(pixel) % size;
    if (std::min(row, column) < kEdgePixels || std::max(row, column) >= size - kEdgePixels) return false;
    for (int down = -kEdgePixels; down <= kEdgePixels; ++down)
        for (int right = -kEdgePixels; right <= kEdgePixels; ++right)
            if (!truth[static_cast<std::size_t>((row + down) * size + column + right)].hit()) return false;
    return true;
}

void count(const Sight& truth, const Sight& picture, bool inside, const Judgement& judgement, float tolerance,
           PictureErrors& errors) {
    errors.truth += truth.hit();
    errors.picture += picture.hit();
    errors.either += truth.hit() || picture.hit();
    errors.inside += inside;
    errors.holes += inside && !picture.hit();
    errors.false_surface += judgement.false_surface;
    errors.floating += judgement.floating;
    if (!truth.hit() || !picture.hit()) return;
    ++errors.both;
    errors.depth_off += std::abs(picture.t - truth.t) > tolerance;
    const double degrees = degreesBetweenLines(truth.normal.cast<double>(), picture.normal.cast<double>());
    errors.normal_degrees.push_back(static_cast<float>(degrees));
}

PixelError errorOf(const Sight& truth, const Sight& picture, const Judgement& judgement, float tolerance) {
    if (judgement.floating) return PixelError::kFloating;
    if (!truth.hit() && picture.hit()) return PixelError::kExcess;
    if (judgement.false_surface) return PixelError::kFalseSurface;
    if (!truth.hit()) return PixelError::kNothingThere;
    if (!picture.hit()) return PixelError::kMissing;
    return std::abs(picture.t - truth.t) > tolerance ? PixelError::kDepthOff : PixelError::kRight;
}

} // namespace

AllAndSeen compareSights(const Sights& truth, const Sights& picture, const UnitCamera& camera,
                         const PictureTruth& against) {
    std::vector<Judgement> judgements(truth.size());
    tbb::parallel_for(std::size_t{0}, truth.size(),
                      [&](std::size_t i) { judgements[i] = judge(truth[i], picture[i], i, camera, against); });
    AllAndSeen errors;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool inside = isInside(truth, i, camera.size());
        count(truth[i], picture[i], inside, judgements[i], against.depth_tolerance, errors.all);
        if (judgements[i].seen)
            count(truth[i], picture[i], inside, judgements[i], against.depth_tolerance, errors.seen);
        errors.pixels.push_back(errorOf(truth[i], picture[i], judgements[i], against.depth_tolerance));
    }
    return errors;
}

void writeErrors(const std::string& path, const std::vector<PixelError>& pixels) {
    static constexpr std::array<std::array<std::uint8_t, 3>, 7> kColors{
        {{0, 0, 0}, {96, 96, 96}, {0, 200, 200}, {255, 220, 0}, {60, 90, 255}, {255, 0, 255}, {255, 0, 0}}};
    const auto size = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(pixels.size()))));
    Image8 image{size, size, 3, {}};
    for (const PixelError pixel : pixels) {
        const auto& color = kColors[static_cast<std::size_t>(pixel)];
        image.pixels.insert(image.pixels.end(), color.begin(), color.end());
    }
    writePng(path, image);
}

} // namespace pointrt::quality
