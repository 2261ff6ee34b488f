// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/carried_picture.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <utility>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

/// Two points in neighbouring pixels lie this much of their distance apart before one is behind the other: more than
/// floors seen at a slant.
constexpr float kBehind = 1.02f;
/// What was traced before the light changed counts as this many frames old.
constexpr std::uint32_t kOldLight = 64;
/// Points in a pixel's number of points: besides those that are shown, some that are hidden or beside the picture.
constexpr std::size_t kPointsOf4 = 5;
/// Points that a thread takes at once, and projects side by side.
constexpr std::size_t kChunk = 1u << 14, kSideBySide = 64;

/// The lowest of all threads' keys stays, whatever their order.
void keepNearest(PixelKey& place, PixelKey key) {
    const std::atomic_ref<PixelKey> kept(place);
    PixelKey before = kept.load(std::memory_order_relaxed);
    while (key < before && !kept.compare_exchange_weak(before, key, std::memory_order_relaxed)) continue;
}

} // namespace

// depths are above 0: their bits are in their order
PixelKey keyOf(float ahead, std::uint32_t point) { return PixelKey{std::bit_cast<std::uint32_t>(ahead)} << 32 | point; }

void PointCloud::resize(std::size_t count) {
    x.resize(count);
    y.resize(count);
    z.resize(count);
    info.resize(count, kCarriedGone);
    color.resize(count);
}

void PointCloud::set(std::size_t i, const CarriedPoint& point) {
    x[i] = point.place.x;
    y[i] = point.place.y;
    z[i] = point.place.z;
    info[i] = point.info;
    color[i] = point.color;
}

CarriedPicture::CarriedPicture(PixelSize size) : size_(size) {
    const std::size_t pixels = std::size_t{size.width} * size.height;
    points_.resize(pixels * kPointsOf4 / 4 / kSideBySide * kSideBySide + kSideBySide);
    is_shown_.resize(points_.size());
    keys_.resize(pixels, kNoPoint);
    shown_.resize(pixels);
    holes_.resize(tilesDown());
    tile_colors_.resize(std::size_t{tilesAcross()} * tilesDown());
}

void CarriedPicture::forget() {
    std::fill(points_.info.begin(), points_.info.end(), kCarriedGone);
    std::fill(keys_.begin(), keys_.end(), kNoPoint);
    used_ = cursor_ = 0;
}

void CarriedPicture::carryTo(const CarryView& view) {
    std::fill(keys_.begin(), keys_.end(), kNoPoint);
    std::fill(is_shown_.begin(), is_shown_.end(), std::uint8_t{0});
    forAll((used_ + kChunk - 1) / kChunk,
           [&](std::size_t chunk) { project(view, chunk * kChunk, std::min(kChunk, used_ - chunk * kChunk)); });
    gatherAll();
}

void CarriedPicture::gatherAll() {
    forAll(tilesDown(), [&](std::size_t row) { gather(static_cast<std::uint32_t>(row)); });
    for (const std::vector<std::uint32_t>& row : holes_)
        for (std::uint32_t pixel : row) keys_[pixel] = kNoPoint;
}

/// count points from first on.
void CarriedPicture::project(const CarryView& view, std::size_t first, std::size_t count) {
    const auto width = static_cast<float>(size_.width), height = static_cast<float>(size_.height);
    std::array<CarryView::Seen, kSideBySide> seen;
    for (std::size_t start = first; start < first + count; start += kSideBySide) {
        // there are points to the end of the block: the cloud's size is a multiple
        for (std::size_t i = 0; i < kSideBySide; ++i) {
            const std::size_t at = start + i;
            const float weight = (points_.info[at] & kCarriedSky) != 0 ? 0.0f : 1.0f;
            seen[i] = view.project({points_.x[at], points_.y[at], points_.z[at]}, weight);
        }
        for (std::size_t i = 0; i < kSideBySide; ++i) {
            const CarryView::Seen& at = seen[i];
            const std::uint32_t info = points_.info[start + i];
            if ((info & kCarriedGone) != 0) continue;
            if (!(at.ahead > 0 && at.x >= 0 && at.y >= 0 && at.x < width && at.y < height)) continue;
            const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y);
            const float ahead = (info & kCarriedSky) != 0 ? kSkyAhead : at.ahead;
            keepNearest(keys_[y * size_.width + x], keyOf(ahead, static_cast<std::uint32_t>(start + i)));
        }
    }
}

/// A point behind a surface whose own points have left a gap: most pixels around are well before it.
bool CarriedPicture::showsThrough(std::uint32_t x, std::uint32_t y, PixelKey key) const {
    if (x == 0 || y == 0 || x + 1 >= size_.width || y + 1 >= size_.height) return false;
    const PixelKey* at = &keys_[y * size_.width + x];
    const std::size_t w = size_.width;
    const float ahead = aheadIn(key);
    const auto before = [&](const PixelKey* other) { return aheadIn(*other) * kBehind < ahead ? 1 : 0; };
    const int beside = before(at - 1) + before(at + 1) + before(at - w) + before(at + w);
    if (beside < 2) return false;
    constexpr int kMost = 5; // of 8, that a straight edge of something before it may take
    return beside + before(at - w - 1) + before(at - w + 1) + before(at + w - 1) + before(at + w + 1) > kMost;
}

/// What the points show that have come to lie in a row of tiles.
void CarriedPicture::gather(std::uint32_t tile_row) {
    std::vector<std::uint32_t>& holes = holes_[tile_row];
    holes.clear();
    TileColors* tiles = &tile_colors_[std::size_t{tile_row} * tilesAcross()];
    std::fill(tiles, tiles + tilesAcross(), TileColors{});
    const std::uint32_t end = std::min((tile_row + 1) * TILE_SIDE, size_.height);
    for (std::uint32_t y = tile_row * TILE_SIDE; y < end; ++y)
        for (std::uint32_t x = 0; x < size_.width; ++x) {
            const std::uint32_t pixel = y * size_.width + x;
            const PixelKey key = keys_[pixel];
            if (key == kNoPoint || showsThrough(x, y, key)) {
                holes.push_back(pixel);
                shown_[pixel] = 0xFF000000;
                continue;
            }
            const std::uint32_t color = points_.color[pointIn(key)];
            is_shown_[pointIn(key)] = 1;
            shown_[pixel] = color;
            TileColors& tile = tiles[x / TILE_SIDE];
            const std::array<std::uint32_t, 3> c = channelsOf(color);
            tile.red += c[0];
            tile.green += c[1];
            tile.blue += c[2];
            ++tile.count;
        }
}

void CarriedPicture::noteSceneChange(bool shapes, std::uint32_t frame) {
    constexpr std::uint32_t kKept = kCarriedSky | kCarriedView | kCarriedGuess | kCarriedShape | kCarriedGone;
    const std::uint32_t old = (frame - kOldLight) & kCarriedFrames;
    for (std::uint32_t i = 0; i < used_; ++i) {
        std::uint32_t& info = points_.info[i];
        // samples are of another light: the next one replaces them
        const std::uint32_t age = (frame - info) & kCarriedFrames;
        info = (info & kKept) | (age < kOldLight ? old : info & kCarriedFrames);
        if (shapes && (info & kCarriedShape) != 0) info |= kCarriedGone;
    }
}

void CarriedPicture::takeColors(const std::vector<std::uint32_t>& colors) {
    for (std::uint32_t i = 0; i < used_; ++i)
        if (is_shown_[i] == 0) points_.info[i] |= kCarriedGone;
    for (std::size_t pixel = 0; pixel < keys_.size(); ++pixel)
        if (keys_[pixel] != kNoPoint) points_.color[pointIn(keys_[pixel])] = colors[pixel];
    gatherAll();
}

/// A new one while there is room, then one that the picture does not show.
std::uint32_t CarriedPicture::freePoint() {
    if (used_ < points_.size()) return used_++;
    do {
        cursor_ = (cursor_ + 1) % used_;
    } while (is_shown_[cursor_] != 0); // there are more points than pixels
    return cursor_;
}

void CarriedPicture::put(std::uint32_t pixel, float ahead, const CarriedPoint& point) {
    const std::uint32_t i = isHole(pixel) ? freePoint() : pointIn(keys_[pixel]);
    points_.set(i, point);
    is_shown_[i] = 1;
    keys_[pixel] = keyOf(ahead, i);
    shown_[pixel] = point.color;
}

void CarriedPicture::replace(PointCloud points, const std::vector<float>& ahead) {
    const std::size_t room = points_.size();
    used_ = static_cast<std::uint32_t>(keys_.size());
    cursor_ = 0;
    points_ = std::move(points);
    points_.resize(room);
    for (std::uint32_t pixel = 0; pixel < used_; ++pixel) {
        const bool gone = (points_.info[pixel] & kCarriedGone) != 0;
        keys_[pixel] = gone ? kNoPoint : keyOf(ahead[pixel], pixel);
        is_shown_[pixel] = gone ? 0 : 1;
    }
    std::fill(is_shown_.begin() + used_, is_shown_.end(), std::uint8_t{0});
}

std::uint32_t CarriedPicture::holeCount() const {
    return std::accumulate(holes_.begin(), holes_.end(), 0u, [](std::uint32_t sum, const auto& row) {
        return sum + static_cast<std::uint32_t>(row.size());
    });
}

std::uint64_t CarriedPicture::bytes() const {
    constexpr std::uint64_t kPointBytes = 5 * sizeof(float) + 1;
    return points_.size() * kPointBytes + keys_.size() * (sizeof(PixelKey) + 2 * sizeof(std::uint32_t));
}

std::uint32_t mixed(std::uint32_t a, std::uint32_t b, std::uint32_t share) {
    const std::array<std::uint32_t, 3> from = channelsOf(a), to = channelsOf(b);
    const auto mix = [&](std::size_t c) { return (from[c] * (256 - share) + to[c] * share + 128) >> 8; };
    return wordOf(mix(0), mix(1), mix(2));
}

} // namespace pointrt
