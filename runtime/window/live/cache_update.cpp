// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/cache_update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pointrt {
namespace {

/// View dependence from which a pixel counts as a mirror.
constexpr float kMirrorThreshold = 0.05f;
/// Maximum number of samples to average if light is noise-free: it smooths soft shadows, and the first new sample
/// halves the error of a wrongly reprojected colour.
constexpr std::uint32_t kNoiselessSamples = 1;

std::uint32_t sampleCount(std::uint32_t info) { return info >> kPointSamplesShift & kPointMaxSamples; }

float lengthOf(gpu::vec3 v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

gpu::vec3 directionThrough(const ViewProjection& view, std::uint32_t pixel) {
    return view.direction(pixel % view.size().width, pixel / view.size().width);
}

/// Weight of a new sample in the mean, in units of 1/256.
std::uint32_t blendWeight(std::uint32_t before, std::uint32_t now, const SampleBlending& blending) {
    if ((before & (kPointInterpolated | kPointInvalid)) != 0 ||
        (blending.camera_moves && (now & kPointViewDependent) != 0))
        return 256;
    const std::uint32_t most = blending.noisy ? kPointMaxSamples : kNoiselessSamples;
    return 256 / (std::min(sampleCount(before), most) + 1);
}

std::uint32_t difference(std::uint32_t a, std::uint32_t b) {
    const std::array<std::uint32_t, 3> from = channelsOf(a), to = channelsOf(b);
    std::uint32_t most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, from[c] > to[c] ? from[c] - to[c] : to[c] - from[c]);
    return most;
}

} // namespace

CachedPoint toCachedPoint(const ViewProjection& view, const TracedPixel& traced, std::uint32_t frame) {
    const std::uint32_t x = traced.pixel % view.size().width, y = traced.pixel / view.size().width;
    const gpu::vec3 direction = view.direction(x, y), origin = view.origin(x, y);
    const std::uint32_t info =
        (frame & kPointFrameMask) | (traced.view_dependence > kMirrorThreshold ? kPointViewDependent : 0);
    if (traced.distance < 0) return {direction, info | kPointIsSky, traced.color};
    const float steps = traced.distance / lengthOf(direction);
    return {{origin.x + steps * direction.x, origin.y + steps * direction.y, origin.z + steps * direction.z},
            info | (traced.on_shape ? kPointOnShape : 0),
            traced.color};
}

float depthAlongView(const ViewProjection& view, const TracedPixel& traced) {
    // each length of the direction advances the depth by 1
    return traced.distance < 0 ? kSkyDepth : traced.distance / lengthOf(directionThrough(view, traced.pixel));
}

void insertSamples(RenderCache& cache, ErrorMap& errors, const ViewProjection& view, const SampleBlending& blending,
                   std::span<const TracedPixel> traced) {
    for (const TracedPixel& each : traced) {
        const std::uint32_t width = cache.size().width, x = each.pixel % width, y = each.pixel / width;
        const bool has_point = !cache.isEmpty(each.pixel);
        const std::uint32_t shown = cache.colors()[each.pixel];
        const std::uint32_t before = has_point ? cache.points().info[pointOf(cache.keys()[each.pixel])] : kPointInvalid;
        CachedPoint point = toCachedPoint(view, each, blending.frame);
        const std::uint32_t share = blendWeight(before, point.info, blending);
        const std::uint32_t samples = share == 256 ? 1 : std::min(sampleCount(before) + 1, kPointMaxSamples);
        point.info |= samples << kPointSamplesShift;
        point.color = mixColors(shown, each.color, share);
        // differences due to noise are not errors
        if (has_point && !blending.noisy) errors.record(x, y, difference(shown, each.color));
        cache.insert(each.pixel, depthAlongView(view, each), point);
        TileColorSum& tile = cache.tileColors()[y / TILE_SIDE * cache.tilesAcross() + x / TILE_SIDE];
        const std::array<std::uint32_t, 3> c = channelsOf(each.color);
        const std::uint32_t is_surface = each.distance < 0 ? 0 : 1;
        tile = {tile.red + c[0], tile.green + c[1], tile.blue + c[2], tile.count + 1, tile.surfaces + is_surface};
    }
}

} // namespace pointrt
