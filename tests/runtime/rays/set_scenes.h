// SPDX-License-Identifier: Apache-2.0
// A sphere in map coordinates as one file and as a tile set, and rays through it.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "pointrt/trace.hpp"
#include "runtime/util/vec.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {

/// All arrays of hits, one element per ray.
struct SceneHits {
    explicit SceneHits(std::size_t count)
        : t_hit(count), positions(3 * count), splat_ids(count), instance_ids(count), tile_ids(count),
          normals(3 * count), occluded(count) {}
    HitArrays arrays() { return {t_hit, splat_ids, instance_ids, normals, positions, tile_ids}; }
    Vec3 position(std::size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
    Vec3 normal(std::size_t i) const { return {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]}; }

    std::vector<double> t_hit, positions;
    std::vector<std::uint32_t> splat_ids, instance_ids, tile_ids;
    std::vector<float> normals;
    std::vector<std::uint8_t> occluded;
};

inline SceneHits castBoth(const TraceScene& scene, const std::vector<double>& rays, const RayLimits& limits = {}) {
    SceneHits hits(rays.size() / 6);
    scene.castRays(std::span<const double>(rays), limits, hits.arrays());
    scene.testOcclusions(std::span<const double>(rays), limits, hits.occluded);
    return hits;
}

inline void addRay(std::vector<double>& rays, Vec3 origin, Vec3 direction) {
    rays.insert(rays.end(), {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z});
}
inline Vec3 originOf(const std::vector<double>& rays, std::size_t i) {
    return {rays[6 * i], rays[6 * i + 1], rays[6 * i + 2]};
}
inline Vec3 directionOf(const std::vector<double>& rays, std::size_t i) {
    return {rays[6 * i + 3], rays[6 * i + 4], rays[6 * i + 5]};
}

/// Random rays from within a box around a place, many of them from inside the object there.
inline std::vector<double> raysAround(Vec3 center, double half, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::normal_distribution<double> gauss;
    std::vector<double> rays;
    for (std::size_t i = 0; i < count; ++i)
        addRay(rays, center + half * Vec3{unit(random), unit(random), unit(random)},
               Vec3{gauss(random), gauss(random), gauss(random)});
    return rays;
}

/// A sphere whose points have a unique attribute "number".
struct SphereInTiles {
    static constexpr double kRadius = 40;
    static constexpr std::size_t kSplats = 20000;
    const Vec3 center{500000.25, 4500000.5, 130.125};

    SphereInTiles();

    std::string tiles() const { return folder.file("ball.proset"); }
    std::string whole() const { return folder.file("ball.pro"); }
    std::uint64_t largestTile() const {
        std::uint64_t largest = 0;
        for (const SetTile& tile : set.tiles)
            if (tile.isOriginal()) largest = std::max(largest, tile.bytes);
        return largest;
    }
    std::size_t originals() const {
        return static_cast<std::size_t>(
            std::count_if(set.tiles.begin(), set.tiles.end(), [](const SetTile& tile) { return tile.isOriginal(); }));
    }

    TemporaryFolder folder;
    TileSet set;
    double splat_radius = 0;
    std::vector<Vec3> points; ///< by "number"
};

} // namespace pointrt::test
