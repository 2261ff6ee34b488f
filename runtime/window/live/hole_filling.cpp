// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/hole_filling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

/// Of two depths on one surface, no more than this apart within a pixel.
constexpr float kSameSurfaceRatio = 1.03f;
/// Of the points around a hole, the farthest ones.
struct SurroundingPoints {
    std::uint32_t red = 0, green = 0, blue = 0, count = 0;
    float depth = 0, nearest = kSkyDepth, farthest = 0; ///< a sum; of all
    std::uint32_t sides = 0;                            ///< where, a bit each of the 3 x 3 places, row by row
    std::uint32_t point = 0;                            ///< one of them
};

/// Those that are so far from a pixel, in eight directions.
class Neighbours {
public:
    explicit Neighbours(const RenderCache& cache) : cache_(cache), size_(cache.size()) {}

    SurroundingPoints adjacent(std::uint32_t x, std::uint32_t y) const {
        SurroundingPoints found;
        addRing(found, x, y, 1);
        return found;
    }

    /// The mean of the four beside a pixel, where all are there and on one surface: what most gaps are, told soonest.
    std::optional<std::uint32_t> interpolateOnSurface(std::uint32_t x, std::uint32_t y) const {
        if (x == 0 || y == 0 || x + 1 >= size_.width || y + 1 >= size_.height) return std::nullopt;
        const std::uint32_t at = y * size_.width + x;
        const std::array<std::uint32_t, 4> four{at - 1, at + 1, at - size_.width, at + size_.width};
        float nearest = kSkyDepth, farthest = 0;
        std::array<std::uint32_t, 3> sum{2, 2, 2}; // half of four, for rounding
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

    /// Adds those so far from a pixel.
    void addRing(SurroundingPoints& found, std::uint32_t x, std::uint32_t y, std::uint32_t far) const {
        const std::uint32_t left = x >= far ? x - far : x, right = x + far < size_.width ? x + far : x;
        std::uint32_t direction = 0;
        const std::uint32_t above = y >= far ? y - far : y, below = y + far < size_.height ? y + far : y;
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
        if (depth > found.farthest * kSameSurfaceRatio) // well behind those before it
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

/// They are all of one surface, which goes on from one side of the hole to the other.
bool isContinuous(const SurroundingPoints& found) {
    constexpr std::uint32_t kPlaces = 9;
    std::uint32_t turned = 0;
    for (std::uint32_t i = 0; i < kPlaces; ++i) turned |= (found.sides >> i & 1) << (kPlaces - 1 - i);
    return (found.sides & turned) != 0 && found.nearest * kSameSurfaceRatio >= found.farthest;
}

/// Smooth means of a coarse grid, a colour for each tile.
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

    /// Between those of the four tiles whose middles are around a pixel.
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
    /// Of a tile and those around it, the wider the fewer colours there are.
    std::uint32_t meanOf(std::uint32_t x, std::uint32_t y) const {
        constexpr std::uint32_t kWidest = 4;
        for (std::uint32_t reach = 0; reach <= kWidest; ++reach) {
            TileColorSum sum;
            for (std::uint32_t v = y - std::min(y, reach); v <= std::min(y + reach, down_ - 1); ++v)
                for (std::uint32_t u = x - std::min(x, reach); u <= std::min(x + reach, across_ - 1); ++u) {
                    const TileColorSum& tile = tiles_[v * across_ + u];
                    sum = {sum.red + tile.red, sum.green + tile.green, sum.blue + tile.blue, sum.count + tile.count};
                }
            if (sum.count > 0) return packColor(sum.red / sum.count, sum.green / sum.count, sum.blue / sum.count);
        }
        return packColor(0, 0, 0);
    }

    std::uint32_t across_, down_;
    const std::vector<TileColorSum>& tiles_;
    std::vector<std::uint32_t> colors_;
};

/// Where no surface goes on, those so far are looked at as well, pixels: what comes to light in a frame is seldom wider
/// than twice that. Where a tile has fewer points than an eighth of its pixels, there is seldom one at all.
constexpr std::array<std::uint32_t, 2> kFarRings{3, 7};
constexpr std::uint32_t kMinPointsInTile = TILE_PIXELS / 8;

} // namespace

std::uint32_t fillHoles(RenderCache& cache) {
    const Neighbours neighbours(cache);
    const TileMeans means(cache);
    const std::uint32_t width = cache.size().width;
    const auto fill = [&](std::uint32_t pixel, std::uint32_t& gaps) {
        const std::uint32_t x = pixel % width, y = pixel / width;
        const std::uint32_t known = cache.tileColors()[y / TILE_SIDE * cache.tilesAcross() + x / TILE_SIDE].count;
        if (known < kMinPointsInTile) return means.at(x, y);
        if (const std::optional<std::uint32_t> color = neighbours.interpolateOnSurface(x, y)) {
            ++gaps;
            return *color;
        }
        SurroundingPoints found = neighbours.adjacent(x, y);
        if (isContinuous(found)) {
            ++gaps;
            return colorOf(found);
        }
        for (std::uint32_t far : kFarRings) neighbours.addRing(found, x, y, far);
        return found.count > 0 ? colorOf(found) : means.at(x, y);
    };
    std::vector<std::uint32_t> gaps(cache.disocclusions().size());
    // holes have no points, so that none is filled by another one
    forAll(cache.disocclusions().size(), [&](std::size_t row) {
        for (std::uint32_t pixel : cache.disocclusions()[row])
            if (cache.isEmpty(pixel)) cache.colors()[pixel] = fill(pixel, gaps[row]);
    });
    return std::accumulate(gaps.begin(), gaps.end(), 0u);
}

namespace {

/// What a pixel is given.
struct ResampledPoint {
    float depth = 0;
    std::uint32_t info = 0;
};

/// None where it is not on or between points of a surface.
std::optional<ResampledPoint> resampled(const RenderCache& cache, const Neighbours& neighbours, std::uint32_t pixel) {
    const PixelKey key = cache.keys()[pixel];
    const std::vector<std::uint32_t>& infos = cache.points().info;
    if (key != kEmptyPixel) return ResampledPoint{depthOf(key), infos[pointOf(key)]};
    const std::uint32_t width = cache.size().width;
    const SurroundingPoints found = neighbours.adjacent(pixel % width, pixel / width);
    if (!isContinuous(found)) return std::nullopt;
    return ResampledPoint{found.depth / static_cast<float>(found.count), infos[found.point] | kPointInterpolated};
}

} // namespace

void resamplePoints(RenderCache& cache, const ViewProjection& view) {
    const Neighbours neighbours(cache);
    const PixelSize size = cache.size();
    const std::size_t pixels = cache.keys().size();
    PointCloud points;
    points.resize(pixels);
    std::vector<float> aheads(pixels);
    forAll(size.height, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const std::uint32_t pixel = y * size.width + x;
            const std::optional<ResampledPoint> point = resampled(cache, neighbours, pixel);
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
