// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/render_cache.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "format/base/parallel.h"
#include "runtime/window/live/reprojector.h"

namespace pointrt {
namespace {

/// A neighbouring pixel whose depth is smaller by more than this factor occludes a point. On floors seen at a grazing
/// angle, neighbours differ by less.
constexpr float kOccludedDepthRatio = 1.02f;
/// Next to a straight edge of an occluder, nearer points lie in at most this many of the 8 directions or octants.
constexpr int kMostNearer = 5;
/// Distance in pixels within which to search for nearer points if points are sparse; at most TILE_SIDE.
constexpr std::int32_t kSparseReach = 6;
/// Points are sparse if there is at most one per this many pixels. Where they are denser, a search would take too much
/// time.
constexpr std::size_t kSparsePixels = 4;
/// Points traced before the light changed count as at least this many frames old.
constexpr std::uint32_t kStaleLightAge = 64;
/// Points per thread task, and points projected together with SIMD.
constexpr std::size_t kChunk = 1u << 14, kSideBySide = 64;

/// Lowers target to key atomically. The result does not depend on the order of the threads.
void atomicMin(PixelKey& target, PixelKey key) {
    const std::atomic_ref<PixelKey> lowest(target);
    PixelKey current = lowest.load(std::memory_order_relaxed);
    while (key < current && !lowest.compare_exchange_weak(current, key, std::memory_order_relaxed)) continue;
}

} // namespace

// positive floats sort like their bit patterns
PixelKey makePixelKey(float depth, std::uint32_t point) {
    return PixelKey{std::bit_cast<std::uint32_t>(depth)} << 32 | point;
}

void PointCloud::resize(std::size_t count) {
    x.resize(count);
    y.resize(count);
    z.resize(count);
    info.resize(count, kPointInvalid);
    color.resize(count);
}

void PointCloud::set(std::size_t i, const CachedPoint& point) {
    x[i] = point.position.x;
    y[i] = point.position.y;
    z[i] = point.position.z;
    info[i] = point.info;
    color[i] = point.color;
}

RenderCache::RenderCache(PixelSize size) : size_(size) {
    const std::size_t pixels = std::size_t{size.width} * size.height;
    points_.resize(pixels * kPointsOf4 / 4 / kSideBySide * kSideBySide + kSideBySide);
    is_visible_.resize(points_.size());
    keys_.resize(pixels, kEmptyPixel);
    shown_.resize(pixels);
    empty_pixels_.resize(tilesDown());
    tile_colors_.resize(std::size_t{tilesAcross()} * tilesDown());
    nearest_.resize(tile_colors_.size());
}

void RenderCache::clear() {
    std::fill(points_.info.begin(), points_.info.end(), kPointInvalid);
    std::fill(keys_.begin(), keys_.end(), kEmptyPixel);
    point_count_ = cursor_ = 0;
}

void RenderCache::reproject(const ViewProjection& view) {
    std::fill(keys_.begin(), keys_.end(), kEmptyPixel);
    std::fill(is_visible_.begin(), is_visible_.end(), std::uint8_t{0});
    forAll((point_count_ + kChunk - 1) / kChunk,
           [&](std::size_t chunk) { project(view, chunk * kChunk, std::min(kChunk, point_count_ - chunk * kChunk)); });
    gatherAllRows();
}

void RenderCache::gatherAllRows() {
    is_sparse_ = point_count_ < keys_.size() / kSparsePixels;
    if (is_sparse_) findNearest();
    forAll(tilesDown(), [&](std::size_t row) { gatherRow(static_cast<std::uint32_t>(row)); });
    for (const std::vector<std::uint32_t>& row : empty_pixels_)
        for (std::uint32_t pixel : row) keys_[pixel] = kEmptyPixel;
}

/// Projects count points starting at first.
void RenderCache::project(const ViewProjection& view, std::size_t first, std::size_t count) {
    const auto width = static_cast<float>(size_.width), height = static_cast<float>(size_.height);
    std::array<ViewProjection::Projected, kSideBySide> seen;
    for (std::size_t block = first; block < first + count; block += kSideBySide) {
        // reading past the last point is safe: the capacity is a multiple of the block
        for (std::size_t i = 0; i < kSideBySide; ++i) {
            const std::size_t at = block + i;
            const float weight = (points_.info[at] & kPointIsSky) != 0 ? 0.0f : 1.0f;
            seen[i] = view.project({points_.x[at], points_.y[at], points_.z[at]}, weight);
        }
        for (std::size_t i = 0; i < kSideBySide; ++i) {
            const ViewProjection::Projected& at = seen[i];
            const std::uint32_t info = points_.info[block + i];
            if ((info & kPointInvalid) != 0) continue;
            if (!(at.depth > 0 && at.x >= 0 && at.y >= 0 && at.x < width && at.y < height)) continue;
            const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y);
            const float depth = (info & kPointIsSky) != 0 ? kSkyDepth : at.depth;
            atomicMin(keys_[y * size_.width + x], makePixelKey(depth, static_cast<std::uint32_t>(block + i)));
        }
    }
}

/// True for a point behind a surface that it is seen through: most of its neighbours are clearly nearer.
bool RenderCache::isOccluded(std::uint32_t x, std::uint32_t y, PixelKey key) const {
    if (x == 0 || y == 0 || x + 1 >= size_.width || y + 1 >= size_.height) return false;
    const PixelKey* at = &keys_[y * size_.width + x];
    const std::size_t w = size_.width;
    const float depth = depthOf(key);
    const auto before = [&](const PixelKey* other) { return depthOf(*other) * kOccludedDepthRatio < depth ? 1 : 0; };
    const auto filled = [&](const PixelKey* other) { return *other != kEmptyPixel ? 1 : 0; };
    const int adjacent = before(at - 1) + before(at + 1) + before(at - w) + before(at + w);
    if (adjacent >= 2)
        return adjacent + before(at - w - 1) + before(at - w + 1) + before(at + w - 1) + before(at + w + 1) >
               kMostNearer;
    const bool is_alone = is_sparse_ && filled(at - 1) + filled(at + 1) + filled(at - w) + filled(at + w) < 2;
    return is_alone && mayBeBehind(x / TILE_SIDE, y / TILE_SIDE, depth) && isAmongNearerPoints(x, y, depth);
}

/// Whether nearer points surround a pixel whose neighbours are mostly empty: counts the octants of a growing square
/// that contain any.
bool RenderCache::isAmongNearerPoints(std::uint32_t x, std::uint32_t y, float depth) const {
    std::uint32_t octants = 0;
    const auto look = [&](std::int32_t along_x, std::int32_t along_y) {
        const std::uint32_t at_x = x + static_cast<std::uint32_t>(along_x);
        // beyond the upper edge, the coordinate wraps to a large number
        const std::uint32_t at_y = y + static_cast<std::uint32_t>(along_y);
        if (at_x >= size_.width || at_y >= size_.height) return;
        if (!(depthOf(keys_[at_y * size_.width + at_x]) * kOccludedDepthRatio < depth)) return;
        const bool steep = std::abs(along_y) > std::abs(along_x);
        octants |= 1u << ((along_x < 0 ? 1 : 0) | (along_y < 0 ? 2 : 0) | (steep ? 4 : 0));
    };
    for (std::int32_t reach = 1; reach <= kSparseReach && std::popcount(octants) <= kMostNearer; ++reach)
        for (std::int32_t along = -reach; along < reach; ++along) {
            look(along, -reach);
            look(reach, along);
            look(-along, reach);
            look(-reach, -along);
        }
    return std::popcount(octants) > kMostNearer;
}

/// Whether a point at this depth may lie behind points of this tile or its neighbours.
bool RenderCache::mayBeBehind(std::uint32_t tile_x, std::uint32_t tile_y, float depth) const {
    return anyTileAround(tile_x, tile_y,
                         [&](std::uint32_t tile) { return nearest_[tile] * kOccludedDepthRatio < depth; });
}

void RenderCache::findNearest() {
    forAll(tilesDown(), [&](std::size_t row) {
        float* const nearest = &nearest_[row * tilesAcross()];
        std::fill(nearest, nearest + tilesAcross(), kSkyDepth);
        const std::size_t end = std::min<std::size_t>((row + 1) * TILE_SIDE, size_.height);
        for (std::size_t y = row * TILE_SIDE; y < end; ++y)
            for (std::uint32_t x = 0; x < size_.width; ++x)
                // the NaN of an empty pixel is not less
                if (const float depth = depthOf(keys_[y * size_.width + x]); depth < nearest[x / TILE_SIDE])
                    nearest[x / TILE_SIDE] = depth;
    });
}

/// Collects the visible points and the empty pixels of a row of tiles.
void RenderCache::gatherRow(std::uint32_t tile_row) {
    std::vector<std::uint32_t>& empty_pixels = empty_pixels_[tile_row];
    empty_pixels.clear();
    TileColorSum* tiles = &tile_colors_[std::size_t{tile_row} * tilesAcross()];
    std::fill(tiles, tiles + tilesAcross(), TileColorSum{});
    const std::uint32_t end = std::min((tile_row + 1) * TILE_SIDE, size_.height);
    for (std::uint32_t y = tile_row * TILE_SIDE; y < end; ++y)
        for (std::uint32_t x = 0; x < size_.width; ++x) {
            const std::uint32_t pixel = y * size_.width + x;
            const PixelKey key = keys_[pixel];
            if (key == kEmptyPixel || isOccluded(x, y, key)) {
                empty_pixels.push_back(pixel);
                shown_[pixel] = 0xFF000000;
                continue;
            }
            const std::uint32_t color = points_.color[pointOf(key)];
            is_visible_[pointOf(key)] = 1;
            shown_[pixel] = color;
            TileColorSum& tile = tiles[x / TILE_SIDE];
            const std::array<std::uint32_t, 3> c = channelsOf(color);
            tile.red += c[0];
            tile.green += c[1];
            tile.blue += c[2];
            ++tile.count;
            tile.surfaces += (points_.info[pointOf(key)] & kPointIsSky) != 0 ? 0 : 1;
        }
}

void RenderCache::invalidateLighting(bool shapes, std::uint32_t frame) {
    constexpr std::uint32_t kKeptFlags =
        kPointIsSky | kPointViewDependent | kPointInterpolated | kPointOnShape | kPointInvalid;
    const std::uint32_t old = (frame - kStaleLightAge) & kPointFrameMask;
    for (std::uint32_t i = 0; i < point_count_; ++i) {
        std::uint32_t& info = points_.info[i];
        // sets the sample count to 0, so that the next sample replaces the colour
        const std::uint32_t age = (frame - info) & kPointFrameMask;
        info = (info & kKeptFlags) | (age < kStaleLightAge ? old : info & kPointFrameMask);
        if (shapes && (info & kPointOnShape) != 0) info |= kPointInvalid;
    }
}

void RenderCache::setVisibleColors(const std::vector<std::uint32_t>& colors) {
    for (std::uint32_t i = 0; i < point_count_; ++i)
        if (is_visible_[i] == 0) points_.info[i] |= kPointInvalid;
    for (std::size_t pixel = 0; pixel < keys_.size(); ++pixel)
        if (keys_[pixel] != kEmptyPixel) points_.color[pointOf(keys_[pixel])] = colors[pixel];
    gatherAllRows();
}

/// An unused slot, or else one whose point is not visible.
std::uint32_t RenderCache::allocatePoint() {
    if (point_count_ < points_.size()) return point_count_++;
    do {
        cursor_ = (cursor_ + 1) % point_count_;
    } while (is_visible_[cursor_] != 0); // terminates: there are more slots than pixels
    return cursor_;
}

void RenderCache::insert(std::uint32_t pixel, float depth, const CachedPoint& point) {
    const std::uint32_t i = isEmpty(pixel) ? allocatePoint() : pointOf(keys_[pixel]);
    points_.set(i, point);
    is_visible_[i] = 1;
    keys_[pixel] = makePixelKey(depth, i);
    shown_[pixel] = point.color;
}

void RenderCache::replace(PointCloud points, const std::vector<float>& depth) {
    const std::size_t room = points_.size();
    point_count_ = static_cast<std::uint32_t>(keys_.size());
    cursor_ = 0;
    points_ = std::move(points);
    points_.resize(room);
    for (std::uint32_t pixel = 0; pixel < point_count_; ++pixel) {
        const bool gone = (points_.info[pixel] & kPointInvalid) != 0;
        keys_[pixel] = gone ? kEmptyPixel : makePixelKey(depth[pixel], pixel);
        is_visible_[pixel] = gone ? 0 : 1;
    }
    std::fill(is_visible_.begin() + point_count_, is_visible_.end(), std::uint8_t{0});
}

std::uint32_t RenderCache::emptyPixelCount() const {
    return std::accumulate(empty_pixels_.begin(), empty_pixels_.end(), 0u, [](std::uint32_t sum, const auto& row) {
        return sum + static_cast<std::uint32_t>(row.size());
    });
}

std::uint64_t RenderCache::bytes() const {
    constexpr std::uint64_t kPointBytes = 5 * sizeof(float) + 1;
    return points_.size() * kPointBytes + keys_.size() * (sizeof(PixelKey) + 2 * sizeof(std::uint32_t));
}

std::uint32_t mixColors(std::uint32_t a, std::uint32_t b, std::uint32_t share) {
    const std::array<std::uint32_t, 3> from = channelsOf(a), to = channelsOf(b);
    const auto mix = [&](std::size_t c) { return (from[c] * (256 - share) + to[c] * share + 128) >> 8; };
    return packColor(mix(0), mix(1), mix(2));
}

} // namespace pointrt
