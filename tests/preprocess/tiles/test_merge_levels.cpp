// SPDX-License-Identifier: Apache-2.0
// Levels of surfaces and foliage: closed surfaces stay closed, and shadows keep their density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "preprocess/tiles/merge_disc.h"
#include "preprocess/tiles/merge_tile.h"
#include "preprocess/tiles/select_splats.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

/// The unit cube is one tile of level 3, and so are those of the levels below it.
constexpr std::uint32_t kTop = 3;

TileSet unitLattice() {
    TileSet set;
    set.edge = std::ldexp(1.0, -static_cast<int>(kTop));
    return set;
}

struct Level {
    std::vector<std::pair<TileKey, TileSplats>> tiles;

    std::size_t count() const {
        std::size_t sum = 0;
        for (const auto& [key, splats] : tiles) sum += splats.positions.size();
        return sum;
    }
};

Level finest(const Splats& splats, const std::vector<Attribute>& attributes = {}) {
    const TileSet set = unitLattice();
    Level level;
    for (std::int32_t cell = 0; cell < 512; ++cell) {
        const TileKey key{0, {cell & 7, cell >> 3 & 7, cell >> 6}};
        const std::vector<PositionCode> codes = codesOf(set, key, splats);
        std::vector<std::uint8_t> kept(codes.size());
        std::transform(codes.begin(), codes.end(), kept.begin(), [](const auto& code) { return isInCore(code); });
        TileSplats taken = selectSplats(splats, attributes, codes, kept, set.edge);
        if (!taken.positions.empty()) level.tiles.emplace_back(key, std::move(taken));
    }
    return level;
}

Level mergeLevel(const Level& finer, bool oriented = true) {
    std::map<TileKey, std::vector<MergeChild>> children;
    for (const auto& [key, splats] : finer.tiles)
        children[parentOf(key)].push_back({key, viewOf(splats), splats.error});
    Level level;
    const std::vector<Attribute> schema = emptyLike(finer.tiles.front().second).attributes;
    for (const auto& [parent, of_it] : children)
        level.tiles.emplace_back(parent, mergeSplats(parent, of_it, schema, edgeOf(unitLattice(), parent.level),
                                                     std::uint64_t{1} << 40, oriented));
    return level;
}

/// A level's discs in the unit cube.
MergeDiscs discsOf(const Level& level) {
    const TileSet set = unitLattice();
    MergeDiscs discs;
    for (const auto& [key, splats] : level.tiles)
        for (std::size_t i = 0; i < splats.positions.size(); ++i) {
            discs.positions.push_back(positionOf(set, key, splats.positions[i]).cast<float>());
            discs.normals.push_back(normalOf(splats.normals[i]));
            discs.radii.push_back(splats.radii[i]);
        }
    return discs;
}

struct Ray {
    Vec3f origin, direction;
};

bool meets(const Ray& ray, const MergeDiscs& discs) {
    for (std::size_t i = 0; i < discs.positions.size(); ++i) {
        const float slope = ray.direction.dot(discs.normals[i]);
        const Vec3f way = discs.positions[i] - ray.origin;
        if (std::abs(slope) < 1e-6f) continue;
        const Vec3f off = way - way.dot(discs.normals[i]) / slope * ray.direction;
        if (off.squaredNorm() <= discs.radii[i] * discs.radii[i]) return true;
    }
    return false;
}

double shareOfHits(const std::vector<Ray>& rays, const MergeDiscs& discs) {
    std::size_t met = 0;
    for (const Ray& ray : rays) met += meets(ray, discs);
    return static_cast<double>(met) / static_cast<double>(rays.size());
}

Vec3f randomDirection(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Vec3f(normal(random), normal(random), normal(random)).normalized();
}

/// Parallel rays through points of a disc that faces them.
std::vector<Ray> raysThrough(const Vec3f& center, float radius, std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const Vec3f direction = randomDirection(random), u = direction.unitOrthogonal(), v = direction.cross(u);
        const float angle = 2 * std::numbers::pi_v<float> * share(random), off = radius * std::sqrt(share(random));
        rays.push_back({center + off * (std::cos(angle) * u + std::sin(angle) * v) - 3 * direction, direction});
    }
    return rays;
}

/// A plane at an angle to the lattice, sampled at random: its discs leave no hole on any level.
TEST(MergeLevels, APlaneStaysCovered) {
    const Vec3f center(0.5f, 0.5f, 0.5f), u(0.3f, 0.1f, 0.05f), v(-0.12f, 0.28f, 0.1f);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> both(-1, 1), few(-0.4f, 0.4f);
    Splats plane = squareSplats(100, center, u, v, 1.0f);
    const Vec3f normal = u.cross(v).normalized();
    for (Vec3f& position : plane.positions) position += 0.003f * (both(random) * u + both(random) * v) / 0.3f;
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
        const Vec3f through = center + 2 * few(random) * u + 2 * few(random) * v;
        Vec3f direction = randomDirection(random);
        if (std::abs(direction.dot(normal)) < 0.05f) direction = normal;
        rays.push_back({through - 2 * direction, direction});
    }
    Level level = finest(plane);
    ASSERT_EQ(shareOfHits(rays, discsOf(level)), 1);
    std::size_t finer = level.count();
    for (std::uint32_t k = 1; k <= kTop; ++k) {
        level = mergeLevel(level);
        EXPECT_EQ(shareOfHits(rays, discsOf(level)), 1) << "level " << k;
        EXPECT_NEAR(static_cast<double>(level.count()) / static_cast<double>(finer), 0.25, 0.06) << "level " << k;
        finer = level.count();
    }
}

TEST(MergeLevels, ASphereKeepsItsSizeAndErrorBoundsTheDistance) {
    const Vec3f center(0.47f, 0.52f, 0.5f);
    constexpr float kRadius = 0.35f;
    Level level = finest(sphereSplats(20000, center, kRadius, 1.0f));
    const std::vector<Ray> rays = raysThrough(center, 1.3f * kRadius, 4000);
    const double before = shareOfHits(rays, discsOf(level));
    EXPECT_NEAR(before, 1 / (1.3 * 1.3), 0.02);
    for (std::uint32_t k = 1; k <= kTop; ++k) {
        level = mergeLevel(level);
        const MergeDiscs discs = discsOf(level);
        EXPECT_NEAR(shareOfHits(rays, discs) / before, 1, 0.02 * std::exp2(k - 1)) << "level " << k;
        double off = 0, error = 0, spacing = 0;
        for (const Vec3f& each : discs.positions)
            off = std::max(off, std::abs(double((each - center).norm()) - kRadius));
        for (const auto& [key, splats] : level.tiles) {
            error = std::max(error, splats.error);
            spacing = std::max(spacing, splats.spacing);
            EXPECT_GE(splats.error, splats.spacing / 4);
        }
        EXPECT_LT(off, error) << "level " << k;
        EXPECT_LT(error, 2 * spacing) << "level " << k; // a larger error would make viewers refine needlessly
    }
}

/// Leaves of a tree at random orientations in a ball: every level transmits the same light.
TEST(MergeLevels, FoliageKeepsItsTransmittance) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> both(-1, 1), size(0.7f, 1.3f);
    Splats leaves;
    const Vec3f center(0.5f, 0.5f, 0.5f);
    constexpr float kRadius = 0.4f;
    while (leaves.positions.size() < 16000) {
        const Vec3f place(both(random), both(random), both(random));
        if (place.norm() > 1) continue;
        leaves.positions.push_back(center + kRadius * place);
        leaves.normals.push_back(randomDirection(random));
        leaves.radii.push_back(0.0065f * size(random));
        leaves.input_index.push_back(static_cast<std::uint32_t>(leaves.input_index.size()));
    }
    leaves.input_count = 16000;
    const std::vector<Ray> rays = raysThrough(center, 0.8f * kRadius, 6000);
    Level level = finest(leaves);
    const double before = 1 - shareOfHits(rays, discsOf(level));
    EXPECT_GT(before, 0.05);
    EXPECT_LT(before, 0.6);
    for (std::uint32_t k = 1; k <= 2; ++k) {
        level = mergeLevel(level);
        EXPECT_NEAR(1 - shareOfHits(rays, discsOf(level)), before, 0.04) << "level " << k;
    }
}

/// Two sheets back to back, closer than the width of cells: both remain on every level.
TEST(MergeLevels, SidesOfAPlateStayApart) {
    const Splats front = squareSplats(80, {0.5f, 0.5f, 0.5f}, {0.4f, 0, 0}, {0, 0.4f, 0});
    const Splats back = squareSplats(80, {0.5f, 0.5f, 0.499f}, {0, 0.4f, 0}, {0.4f, 0, 0});
    Level level = finest(joinSplats(front, back));
    for (std::uint32_t k = 1; k <= kTop; ++k) {
        level = mergeLevel(level);
        const MergeDiscs discs = discsOf(level);
        std::size_t up = 0;
        for (std::size_t i = 0; i < discs.normals.size(); ++i) {
            up += discs.normals[i].z() > 0;
            EXPECT_NEAR(discs.positions[i].z(), discs.normals[i].z() > 0 ? 0.5f : 0.499f, 1e-5f);
            EXPECT_NEAR(std::abs(discs.normals[i].z()), 1, 1e-5f);
        }
        EXPECT_NEAR(2 * static_cast<double>(up) / static_cast<double>(discs.normals.size()), 1, 0.03);
    }
}

TEST(MergeLevels, TheRootRespectsTheLimit) {
    const Level level = finest(sphereSplats(20000, {0.5f, 0.5f, 0.5f}, 0.35f));
    std::vector<MergeChild> children;
    for (const auto& [key, splats] : level.tiles)
        if (parentOf(key) == TileKey{1, {0, 0, 0}} || parentOf(key) == TileKey{1, {1, 1, 0}})
            children.push_back({key, viewOf(splats), 0});
    std::erase_if(children,
                  [&](const MergeChild& each) { return parentOf(each.tile) != parentOf(children.front().tile); });
    const TileKey parent = parentOf(children.front().tile);
    const TileSplats merged = mergeSplats(parent, children, {}, 0.25, 40, true);
    EXPECT_LT(merged.positions.size(), 80u);
    EXPECT_GT(merged.positions.size(), 20u);
}

/// The same splats in any order of children give the same bytes.
TEST(MergeLevels, OrderOfChildrenDoesNotMatter) {
    const Level level = finest(sphereSplats(20000, {0.5f, 0.5f, 0.5f}, 0.35f));
    std::map<TileKey, std::vector<MergeChild>> parents;
    for (const auto& [key, splats] : level.tiles) parents[parentOf(key)].push_back({key, viewOf(splats), 0});
    for (auto& [parent, children] : parents) {
        const TileSplats one = mergeSplats(parent, children, {}, 0.25, 1000000, true);
        std::reverse(children.begin(), children.end());
        const TileSplats other = mergeSplats(parent, children, {}, 0.25, 1000000, true);
        EXPECT_EQ(one.positions, other.positions);
        EXPECT_EQ(one.radii, other.radii);
        EXPECT_EQ(one.normals, other.normals);
    }
}

} // namespace
} // namespace pointrt::test
