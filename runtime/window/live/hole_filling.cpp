// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/hole_filling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

/// Neighbouring depths within this ratio belong to one surface.
constexpr float kSameSurfaceRatio = 1.03f;
/// The points around an empty pixel. Sums and sides include only those on the farthest surface.
struct SurroundingPoints {
    std::uint32_t red = 0, green = 0, blue = 0, count = 0;
    float depth = 0, nearest = kSkyDepth, farthest = 0; ///< depth: a sum; nearest and farthest: over all neighbours
    std::uint32_t sides = 0; ///< a bit for each of the 3 x 3 positions, by row, where points were found
    std::uint32_t point = 0; ///< index of one of them
};

/// Collects points from the pixels around a pixel.
class NeighborSampler {
public:
    explicit NeighborSampler(const RenderCache& cache) : cache_(cache), size_(cache.size()) {}

    SurroundingPoints adjacent(std::uint32_t x, std::uint32_t y) const {
        SurroundingPoints found;
        addRing(found, x, y, 1);
        return found;
    }

    /// The mean of the four direct neighbours if all are on one surface: the fastest test, which suffices for most
    /// gaps.
    std::optional<std::uint32_t> interpolateOnSurface(std::uint32_t x, std::uint32_t y) const {
        if (x == 0 || y == 0 || x + 1 >= size_.width || y + 1 >= size_.height) return std::nullopt;
        const std::uint32_t at = y * size_.width + x;
        const std::array<std::uint32_t, 4> four{at - 1, at + 1, at - size_.width, at + size_.width};
        float nearest = kSkyDepth, farthest = 0;
        std::array<std::uint32_t, 3> sum{2, 2, 2}; // half of the divisor, to round
        for (std::uint32_t pixel : four) {
            const PixelKey key = cache_.keys()[pixel];
            if (key == kEmptyPixel) return std::nullopt;
            nearest = std::min(nearest, depthOf(key));
            farthest = std::max(farthest, depthOf(key));
            const std::array<std::uint32_t, 3> c = channelsOf(cache_.colors()[pixel]);
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += c[k];
        }
        if (nearest * kSameSurfaceRatio < farthest) return std::nullopt;
        return packColor(sum[0] / 4, sum[1] / 4, sum[2] / 4);
    }

    /// Adds the points of the pixels to the left and right, above and below, and in the four diagonal directions, at
    /// this distance along x and y.
    void addRing(SurroundingPoints& found, std::uint32_t x, std::uint32_t y, std::uint32_t radius) const {
        const std::uint32_t left = x >= radius ? x - radius : x, right = x + radius < size_.width ? x + radius : x;
        std::uint32_t direction = 0;
        const std::uint32_t above = y >= radius ? y - radius : y, below = y + radius < size_.height ? y + radius : y;
        for (std::uint32_t at_y : {above, y, below})
            for (std::uint32_t at_x : {left, x, right}) addNeighbor(found, at_y * size_.width + at_x, direction++);
    }

private:
    void addNeighbor(SurroundingPoints& found, std::uint32_t pixel, std::uint32_t direction) const {
        const PixelKey key = cache_.keys()[pixel];
        if (key == kEmptyPixel) return;
        const float depth = depthOf(key);
        found.nearest = std::min(found.nearest, depth);
        if (depth * kSameSurfaceRatio < found.farthest) return;
        if (depth > found.farthest * kSameSurfaceRatio) // well behind the points found so far
            found = {0, 0, 0, 0, 0, found.nearest, found.farthest, 0, 0};
        found.farthest = std::max(found.farthest, depth);
        const std::array<std::uint32_t, 3> c = channelsOf(cache_.colors()[pixel]);
        found.red += c[0];
        found.green += c[1];
        found.blue += c[2];
        found.depth += depth;
        found.point = pointOf(key);
        ++found.count;
        found.sides |= 1u << direction;
    }

    const RenderCache& cache_;
    PixelSize size_;
};

std::uint32_t colorOf(const SurroundingPoints& found) {
    return packColor(found.red / found.count, found.green / found.count, found.blue / found.count);
}

/// True if all points are on one surface, and two of them face each other across the pixel.
bool isContinuous(const SurroundingPoints& found) {
    constexpr std::uint32_t kPlaces = 9;
    std::uint32_t turned = 0;
    for (std::uint32_t i = 0; i < kPlaces; ++i) turned |= (found.sides >> i & 1) << (kPlaces - 1 - i);
    return (found.sides & turned) != 0 && found.nearest * kSameSurfaceRatio >= found.farthest;
}

/// Smoothed mean colour of each tile.
class TileMeans {
public:
    explicit TileMeans(const RenderCache& cache)
        : across_(cache.tilesAcross()), down_(cache.tilesDown()), tiles_(cache.tileColors()) {
        colors_.resize(tiles_.size());
        forAll(down_, [&](std::size_t row) {
            for (std::uint32_t x = 0; x < across_; ++x)
                colors_[row * across_ + x] = meanOf(x, static_cast<std::uint32_t>(row));
        });
    }

    /// Bilinear interpolation between the centres of the four nearest tiles.
    std::uint32_t at(std::uint32_t x, std::uint32_t y) const {
        const auto along = [](std::uint32_t pixel, std::uint32_t tiles) {
            return std::clamp((static_cast<float>(pixel) + 0.5f) / TILE_SIDE - 0.5f, 0.0f,
                              static_cast<float>(tiles - 1));
        };
        const float u = along(x, across_), v = along(y, down_);
        const auto u0 = static_cast<std::uint32_t>(u), v0 = static_cast<std::uint32_t>(v);
        const std::uint32_t u1 = std::min(u0 + 1, across_ - 1), v1 = std::min(v0 + 1, down_ - 1);
        const auto s = static_cast<std::uint32_t>(256 * (u - static_cast<float>(u0)));
        const auto t = static_cast<std::uint32_t>(256 * (v - static_cast<float>(v0)));
        const auto color = [&](std::uint32_t i, std::uint32_t j) { return colors_[j * across_ + i]; };
        return mixColors(mixColors(color(u0, v0), color(u1, v0), s), mixColors(color(u0, v1), color(u1, v1), s), t);
    }

private:
    /// The mean over the smallest neighbourhood of tiles that has any colours.
    std::uint32_t meanOf(std::uint32_t x, std::uint32_t y) const {
        constexpr std::uint32_t kWidest = 4;
        for (std::uint32_t reach = 0; reach <= kWidest; ++reach) {
            TileColorSum sum;
            for (std::uint32_t v = y - std::min(y, reach); v <= std::min(y + reach, down_ - 1); ++v)
                for (std::uint32_t u = x - std::min(x, reach); u <= std::min(x + reach, across_ - 1); ++u) {
                    const TileColorSum& tile = tiles_[v * across_ + u];
                    sum = {sum.red + tile.red, sum.green + tile.green, sum.blue + tile.blue, sum.count + tile.count, 0};
                }
            if (sum.count > 0) return packColor(sum.red / sum.count, sum.green / sum.count, sum.blue / sum.count);
        }
        return packColor(0, 0, 0);
    }

    std::uint32_t across_, down_;
    const std::vector<TileColorSum>& tiles_;
    std::vector<std::uint32_t> colors_;
};

/// Distances in pixels at which to look for background around a hole: in one frame, a disocclusion seldom becomes wider
/// than twice the larger one. If a tile has points in fewer than an eighth of its pixels, its holes get the mean
/// colours of tiles instead, since neighbours are rare.
constexpr std::array<std::uint32_t, 2> kFarRings{3, 7};
constexpr std::uint32_t kMinPointsInTile = TILE_PIXELS / 8;

} // namespace

std::uint32_t fillHoles(RenderCache& cache) {
    const NeighborSampler neighbors(cache);
    const TileMeans means(cache);
    const std::uint32_t width = cache.size().width;
    const auto fill = [&](std::uint32_t pixel, std::uint32_t& gaps) {
        const std::uint32_t x = pixel % width, y = pixel / width;
        const std::uint32_t point_count = cache.tileColors()[y / TILE_SIDE * cache.tilesAcross() + x / TILE_SIDE].count;
        if (point_count < kMinPointsInTile) return means.at(x, y);
        if (const std::optional<std::uint32_t> color = neighbors.interpolateOnSurface(x, y)) {
            ++gaps;
            return *color;
        }
        SurroundingPoints found = neighbors.adjacent(x, y);
        if (isContinuous(found)) {
            ++gaps;
            return colorOf(found);
        }
        for (std::uint32_t radius : kFarRings) neighbors.addRing(found, x, y, radius);
        return found.count > 0 ? colorOf(found) : means.at(x, y);
    };
    std::vector<std::uint32_t> gaps(cache.emptyPixels().size());
    // filling reads only pixels with points, so the order does not matter
    forAll(cache.emptyPixels().size(), [&](std::size_t row) {
        for (std::uint32_t pixel : cache.emptyPixels()[row])
            if (cache.isEmpty(pixel)) cache.colors()[pixel] = fill(pixel, gaps[row]);
    });
    return std::accumulate(gaps.begin(), gaps.end(), 0u);
}

namespace {

/// The point to put at a pixel's centre.
struct ResampledPoint {
    float depth = 0;
    std::uint32_t info = 0;
};

/// The pixel's own point, or an interpolated one in a gap within a surface; none for other pixels.
std::optional<ResampledPoint> resampled(const RenderCache& cache, const NeighborSampler& neighbors,
                                        std::uint32_t pixel) {
    const PixelKey key = cache.keys()[pixel];
    const std::vector<std::uint32_t>& infos = cache.points().info;
    if (key != kEmptyPixel) return ResampledPoint{depthOf(key), infos[pointOf(key)]};
    const std::uint32_t width = cache.size().width;
    const SurroundingPoints found = neighbors.adjacent(pixel % width, pixel / width);
    if (!isContinuous(found)) return std::nullopt;
    return ResampledPoint{found.depth / static_cast<float>(found.count), infos[found.point] | kPointInterpolated};
}

} // namespace

void resamplePoints(RenderCache& cache, const ViewProjection& view) {
    const NeighborSampler neighbors(cache);
    const PixelSize size = cache.size();
    const std::size_t pixels = cache.keys().size();
    PointCloud points;
    points.resize(pixels);
    std::vector<float> aheads(pixels);
    forAll(size.height, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const std::uint32_t pixel = y * size.width + x;
            const std::optional<ResampledPoint> point = resampled(cache, neighbors, pixel);
            if (!point) continue;
            const gpu::vec3 direction = view.direction(x, y), origin = view.origin(x, y);
            const float depth = point->depth;
            const gpu::vec3 position{origin.x + depth * direction.x, origin.y + depth * direction.y,
                                     origin.z + depth * direction.z};
            const bool sky = (point->info & kPointIsSky) != 0;
            points.set(pixel, {sky ? direction : position, point->info, cache.colors()[pixel]});
            aheads[pixel] = depth;
        }
    });
    cache.replace(std::move(points), aheads);
}

} // namespace pointrt
