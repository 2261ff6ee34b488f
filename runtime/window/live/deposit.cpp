// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/deposit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pointrt {
namespace {

/// From here on a pixel counts as a mirror.
constexpr float kTurns = 0.05f;
/// Samples that the mean goes over where light does not come by chance: soft shadows are smoothed, and what was carried
/// there wrongly is half gone at once.
constexpr std::uint32_t kQuietSamples = 1;

std::uint32_t samplesIn(std::uint32_t info) { return info >> kCarriedSamplesShift & kCarriedSamplesMost; }

float lengthOf(gpu::vec3 v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

gpu::vec3 wayOf(const CarryView& view, std::uint32_t pixel) {
    return view.way(pixel % view.size().width, pixel / view.size().width);
}

/// Of a traced colour in the mean with what was there, in parts of 256.
std::uint32_t shareOf(std::uint32_t before, std::uint32_t now, const Mixing& mixing) {
    if ((before & (kCarriedGuess | kCarriedGone)) != 0 || (mixing.moves && (now & kCarriedView) != 0)) return 256;
    const std::uint32_t most = mixing.noisy ? kCarriedSamplesMost : kQuietSamples;
    return 256 / (std::min(samplesIn(before), most) + 1);
}

std::uint32_t difference(std::uint32_t a, std::uint32_t b) {
    const std::array<std::uint32_t, 3> from = channelsOf(a), to = channelsOf(b);
    std::uint32_t most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, from[c] > to[c] ? from[c] - to[c] : to[c] - from[c]);
    return most;
}

} // namespace

CarriedPoint pointOf(const CarryView& view, const TracedPixel& traced, std::uint32_t frame) {
    const std::uint32_t x = traced.number % view.size().width, y = traced.number / view.size().width;
    const gpu::vec3 way = view.way(x, y), start = view.start(x, y);
    const std::uint32_t info = (frame & kCarriedFrames) | (traced.view_dependence > kTurns ? kCarriedView : 0);
    if (traced.distance < 0) return {way, info | kCarriedSky, traced.color};
    const float steps = traced.distance / lengthOf(way);
    return {{start.x + steps * way.x, start.y + steps * way.y, start.z + steps * way.z},
            info | (traced.on_shape ? kCarriedShape : 0),
            traced.color};
}

float aheadOf(const CarryView& view, const TracedPixel& traced) {
    // the way goes one ahead for each of its length
    return traced.distance < 0 ? kSkyAhead : traced.distance / lengthOf(wayOf(view, traced.number));
}

void depositPixels(CarriedPicture& picture, ErrorMap& errors, const CarryView& view, const Mixing& mixing,
                   std::span<const TracedPixel> traced) {
    for (const TracedPixel& each : traced) {
        const std::uint32_t width = picture.size().width, x = each.number % width, y = each.number / width;
        const bool known = !picture.isHole(each.number);
        const std::uint32_t shown = picture.shown()[each.number];
        const std::uint32_t before = known ? picture.points().info[pointIn(picture.keys()[each.number])] : kCarriedGone;
        CarriedPoint point = pointOf(view, each, mixing.frame);
        const std::uint32_t share = shareOf(before, point.info, mixing);
        const std::uint32_t samples = share == 256 ? 1 : std::min(samplesIn(before) + 1, kCarriedSamplesMost);
        point.info |= samples << kCarriedSamplesShift;
        point.color = mixed(shown, each.color, share);
        // what comes by chance differs each time
        if (known && !mixing.noisy) errors.note(x, y, difference(shown, each.color));
        picture.put(each.number, aheadOf(view, each), point);
        TileColors& tile = picture.tileColors()[y / TILE_SIDE * picture.tilesAcross() + x / TILE_SIDE];
        const std::array<std::uint32_t, 3> c = channelsOf(each.color);
        tile = {tile.red + c[0], tile.green + c[1], tile.blue + c[2], tile.count + 1};
    }
}

} // namespace pointrt
