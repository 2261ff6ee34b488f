// SPDX-License-Identifier: Apache-2.0
// A render cache (Walter, Drettakis, Parker, Interactive Rendering using the Render Cache, 1999): coloured points of
// earlier frames, reprojected into each new view with a depth test. While the view moves, points are not resampled on
// the screen: each keeps its position and colour until it is traced again, visible or not, so a long movement does not
// blur the picture.
//
// This cache is on the host: a CPU device would take three times as long for the same work. GPUs have their own cache
// (device_cache.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "runtime/util/pixel_size.h"
#include "runtime/window/live/view_projection.h"
#include "shaders/shared/params.h"
#include "shaders/shared/reprojection_layout.h"

namespace pointrt {

constexpr std::uint32_t kPointIsSky = POINT_IS_SKY, kPointViewDependent = POINT_VIEW_DEPENDENT,
                        kPointInterpolated = POINT_INTERPOLATED, kPointOnShape = POINT_ON_SHAPE,
                        kPointInvalid = POINT_INVALID, kPointSamplesShift = POINT_SAMPLES_SHIFT,
                        kPointMaxSamples = POINT_MAX_SAMPLES, kPointFrameMask = POINT_FRAME_MASK;

/// A traced point in render space.
struct CachedPoint {
    gpu::vec3 position{};
    std::uint32_t info = 0, color = 0; ///< 0xAARRGGBB
};

/// Cached points, structure of arrays.
struct PointCloud {
    std::vector<float> x, y, z;
    std::vector<std::uint32_t> info, color;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t count);
    void set(std::size_t i, const CachedPoint& point);
    CachedPoint at(std::size_t i) const { return {{x[i], y[i], z[i]}, info[i], color[i]}; }
};

/// Sum of the colours in one tile, the number of its points, and how many of these are not sky.
struct TileColorSum {
    std::uint32_t red = 0, green = 0, blue = 0, count = 0, surfaces = 0;
};

/// What a pixel shows: depth in the high word, point index in the low one, so that keys sort by depth.
using PixelKey = std::uint64_t;
constexpr PixelKey kEmptyPixel = ~PixelKey{0};
PixelKey makePixelKey(float depth, std::uint32_t point);
/// NaN for an empty pixel, which compares neither nearer nor farther than anything.
inline float depthOf(PixelKey key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }
inline std::uint32_t pointOf(PixelKey key) { return static_cast<std::uint32_t>(key); }
/// Depth of the sky.
constexpr float kSkyDepth = 1e30f;

class RenderCache {
public:
    /// All pixels empty. size: at least 1 x 1.
    explicit RenderCache(PixelSize size);

    PixelSize size() const { return size_; }
    /// Empties all pixels.
    void clear();
    /// Projects all points into view. Points seen through gaps in a nearer surface are hidden.
    void reproject(const ViewProjection& view);
    /// Marks all colours as outdated. shapes: shapes have changed as well, which removes the points on them.
    void invalidateLighting(bool shapes, std::uint32_t frame);
    /// Sets the colours of the visible points from a picture, and removes the hidden ones, whose new colours are
    /// unknown.
    void setVisibleColors(const std::vector<std::uint32_t>& colors);
    /// Replaces the point that pixel shows, or adds one to an empty pixel.
    void insert(std::uint32_t pixel, float depth, const CachedPoint& point);
    /// Replaces all points: one per pixel, at these depths.
    void replace(PointCloud points, const std::vector<float>& depth);

    const std::vector<PixelKey>& keys() const { return keys_; }
    const PointCloud& points() const { return points_; }
    /// The picture, 0xAARRGGBB per pixel. Empty pixels are black until fillHoles.
    std::vector<std::uint32_t>& colors() { return shown_; }
    const std::vector<std::uint32_t>& colors() const { return shown_; }
    /// Pixels that were empty after reproject, by row of tiles.
    const std::vector<std::vector<std::uint32_t>>& emptyPixels() const { return empty_pixels_; }
    std::uint32_t emptyPixelCount() const;
    bool isEmpty(std::uint32_t pixel) const { return keys_[pixel] == kEmptyPixel; }
    /// Colour sums of the visible points, by tile.
    std::vector<TileColorSum>& tileColors() { return tile_colors_; }
    const std::vector<TileColorSum>& tileColors() const { return tile_colors_; }
    std::uint32_t tilesAcross() const { return (size_.width + TILE_SIDE - 1) / TILE_SIDE; }
    std::uint32_t tilesDown() const { return (size_.height + TILE_SIDE - 1) / TILE_SIDE; }
    /// Whether the number of a tile, or of one of its eight neighbours, satisfies a condition.
    template <typename Condition>
    bool anyTileAround(std::uint32_t tile_x, std::uint32_t tile_y, const Condition& condition) const {
        for (std::uint32_t y = tile_y - std::min(tile_y, 1u); y <= std::min(tile_y + 1, tilesDown() - 1); ++y)
            for (std::uint32_t x = tile_x - std::min(tile_x, 1u); x <= std::min(tile_x + 1, tilesAcross() - 1); ++x)
                if (condition(y * tilesAcross() + x)) return true;
        return false;
    }
    std::uint64_t bytes() const;

private:
    void project(const ViewProjection& view, std::size_t first, std::size_t count);
    void gatherRow(std::uint32_t tile_row);
    void gatherAllRows();
    bool isOccluded(std::uint32_t x, std::uint32_t y, PixelKey key) const;
    bool isAmongNearerPoints(std::uint32_t x, std::uint32_t y, float depth) const;
    bool mayBeBehind(std::uint32_t tile_x, std::uint32_t tile_y, float depth) const;
    void findNearest();
    std::uint32_t allocatePoint();

    PixelSize size_;
    PointCloud points_;
    std::uint32_t point_count_ = 0;        ///< slots used so far
    std::uint32_t cursor_ = 0;             ///< where the search for a replaceable point continues
    std::vector<std::uint8_t> is_visible_; ///< by point
    std::vector<PixelKey> keys_;           ///< by pixel
    std::vector<std::uint32_t> shown_;
    std::vector<std::vector<std::uint32_t>> empty_pixels_;
    std::vector<TileColorSum> tile_colors_;
    bool is_sparse_ = false;
    std::vector<float> nearest_; ///< depth by tile if is_sparse_; kSkyDepth without points
};

/// Channels of a packed colour, red first.
inline std::array<std::uint32_t, 3> channelsOf(std::uint32_t word) {
    return {word >> 16 & 255, word >> 8 & 255, word & 255};
}
inline std::uint32_t packColor(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return 0xFF000000 | red << 16 | green << 8 | blue;
}
/// a * (256 - share) + b * share, in units of 1/256.
std::uint32_t mixColors(std::uint32_t a, std::uint32_t b, std::uint32_t share);

} // namespace pointrt
