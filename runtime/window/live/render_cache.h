// SPDX-License-Identifier: Apache-2.0
// A picture that goes along with the camera: points of the scene with their colours on the screen, put where they lie
// in the picture to come, the nearest before the others. Points are never resampled: each keeps its place and its
// colour until it is traced anew, hidden or not, so that nothing blurs however long things move (Walter, Drettakis,
// Parker, Interactive Rendering using the Render Cache, 1999).
//
// It lives on the host: software devices, the ones too slow to trace a whole picture in a frame, take three times as
// long for the same.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "runtime/util/pixel_size.h"
#include "runtime/window/live/view_projection.h"
#include "shaders/shared/params.h"

namespace pointrt {

// What is known of a point: PointCloud::info. The rest are samples that its colour is the mean of, and below them the
// frame in which it was traced.
constexpr std::uint32_t kPointIsSky = 1u << 31;         ///< its place is a direction
constexpr std::uint32_t kPointViewDependent = 1u << 30; ///< mirrors and the like: it looks another way from elsewhere
constexpr std::uint32_t kPointInterpolated = 1u << 29;  ///< put between others, never traced
constexpr std::uint32_t kPointOnShape = 1u << 28;       ///< on a shape
constexpr std::uint32_t kPointInvalid = 1u << 27;       ///< nowhere any more
constexpr std::uint32_t kPointSamplesShift = 16, kPointMaxSamples = 7, kPointFrameMask = 0xFFFF;

/// A point that was seen, in render space.
struct CachedPoint {
    gpu::vec3 position{};
    std::uint32_t info = 0, color = 0; ///< 0xAARRGGBB
};

/// Their arrays.
struct PointCloud {
    std::vector<float> x, y, z;
    std::vector<std::uint32_t> info, color;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t count);
    void set(std::size_t i, const CachedPoint& point);
    CachedPoint at(std::size_t i) const { return {{x[i], y[i], z[i]}, info[i], color[i]}; }
};

/// Sums of a tile's colours.
struct TileColorSum {
    std::uint32_t red = 0, green = 0, blue = 0, count = 0;
};

/// What a pixel shows: how far ahead of the eye it is, and the point's number. Ordered by depth.
using PixelKey = std::uint64_t;
constexpr PixelKey kEmptyPixel = ~PixelKey{0};
PixelKey makePixelKey(float depth, std::uint32_t point);
/// Of a pixel without a point: NaN, which is neither before nor behind anything.
inline float depthOf(PixelKey key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }
inline std::uint32_t pointOf(PixelKey key) { return static_cast<std::uint32_t>(key); }
/// How far the sky is.
constexpr float kSkyDepth = 1e30f;

class RenderCache {
public:
    /// Nothing but holes. size: at least 1 x 1.
    explicit RenderCache(PixelSize size);

    PixelSize size() const { return size_; }
    /// Nothing but holes again.
    void clear();
    /// All points to where view sees them. Those that are seen through gaps of a nearer surface are not shown.
    void reproject(const ViewProjection& view);
    /// The light has changed, and where shapes have too, what lies on them is gone.
    void invalidateLighting(bool shapes, std::uint32_t frame);
    /// Shown colours become those of their points. Of those that are hidden the colours are not known: they go.
    void setVisibleColors(const std::vector<std::uint32_t>& colors);
    /// Puts a point in place of the one that pixel shows, or of none.
    void insert(std::uint32_t pixel, float depth, const CachedPoint& point);
    /// As if points were all there is, one a pixel, ahead of the eye by so much.
    void replace(PointCloud points, const std::vector<float>& depth);

    const std::vector<PixelKey>& keys() const { return keys_; }
    const PointCloud& points() const { return points_; }
    /// What is shown, 0xAARRGGBB each; of holes black, until they are filled.
    std::vector<std::uint32_t>& colors() { return shown_; }
    const std::vector<std::uint32_t>& colors() const { return shown_; }
    /// Pixels without a point when the picture was carried, by rows of tiles.
    const std::vector<std::vector<std::uint32_t>>& disocclusions() const { return empty_pixels_; }
    std::uint32_t emptyPixelCount() const;
    bool isEmpty(std::uint32_t pixel) const { return keys_[pixel] == kEmptyPixel; }
    /// Of what points show, by tiles.
    std::vector<TileColorSum>& tileColors() { return tile_colors_; }
    const std::vector<TileColorSum>& tileColors() const { return tile_colors_; }
    std::uint32_t tilesAcross() const { return (size_.width + TILE_SIDE - 1) / TILE_SIDE; }
    std::uint32_t tilesDown() const { return (size_.height + TILE_SIDE - 1) / TILE_SIDE; }
    std::uint64_t bytes() const;

private:
    void project(const ViewProjection& view, std::size_t first, std::size_t count);
    void gatherRow(std::uint32_t tile_row);
    void gatherAllRows();
    bool isOccluded(std::uint32_t x, std::uint32_t y, PixelKey key) const;
    std::uint32_t allocatePoint();

    PixelSize size_;
    PointCloud points_;
    std::uint32_t point_count_ = 0;        ///< points that there ever were
    std::uint32_t cursor_ = 0;             ///< where the search for one that can be spared goes on
    std::vector<std::uint8_t> is_visible_; ///< of points
    std::vector<PixelKey> keys_;           ///< of pixels
    std::vector<std::uint32_t> shown_;
    std::vector<std::vector<std::uint32_t>> empty_pixels_;
    std::vector<TileColorSum> tile_colors_;
};

/// A colour's channels, red first.
inline std::array<std::uint32_t, 3> channelsOf(std::uint32_t word) {
    return {word >> 16 & 255, word >> 8 & 255, word & 255};
}
inline std::uint32_t packColor(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return 0xFF000000 | red << 16 | green << 8 | blue;
}
/// a, and share of 256 parts of b in its place.
std::uint32_t mixColors(std::uint32_t a, std::uint32_t b, std::uint32_t share);

} // namespace pointrt
