// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/merge_disc.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace pointrt {
namespace {

std::vector<std::uint32_t> allOf(const MergeDiscs& discs) {
    std::vector<std::uint32_t> members(discs.positions.size());
    std::iota(members.begin(), members.end(), 0u);
    return members;
}

TEST(MergeDisc, CoversDiscsSideBySide) {
    const Vec3f up(0, 0, 1);
    const MergeDiscs discs{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {up, up, up, up}, {1, 1, 1, 1}};
    const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
    EXPECT_TRUE(merged.position.isApprox(Vec3f(0.5f, 0.5f, 0)));
    EXPECT_TRUE(merged.normal.isApprox(up));
    EXPECT_FLOAT_EQ(merged.radius, std::sqrt(0.5f) + 1 / 1.2f);
    EXPECT_NEAR(merged.error, 1 - 1 / 1.2f, 1e-6); // by how much the rims of the members extend beyond the merged disc
}

TEST(MergeDisc, MeansAreByArea) {
    const Vec3f up(0, 0, 1), aside = Vec3f(0.6f, 0, 0.8f);
    const MergeDiscs discs{{{0, 0, 0}, {5, 0, 0}}, {up, aside}, {2, 1}};
    const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
    EXPECT_TRUE(merged.position.isApprox(Vec3f(1, 0, 0)));
    EXPECT_TRUE(merged.normal.isApprox((4 * up + aside).normalized()));
}

TEST(MergeDisc, KeepsTheAreaOfScatteredDiscs) {
    const Vec3f up(0, 0, 1);
    const MergeDiscs discs{{{0, 0, 0}, {300, 0, 200}, {0, 300, -200}}, {up, up, up}, {1, 2, 2}};
    const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
    EXPECT_NEAR(merged.radius, 3, 1e-3);
    EXPECT_GT(merged.error, 200); // distance of the upper disc from the plane of the merged one
}

/// Discs at random in a cube of edge 1, facing within 60 degrees of a normal.
MergeDiscs scatteredDiscs(int count, float radius, std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    const auto direction = [&] { return Vec3f(normal(random), normal(random), normal(random)).normalized(); };
    const Vec3f facing = direction();
    MergeDiscs discs;
    while (static_cast<int>(discs.radii.size()) < count) {
        const Vec3f candidate = direction();
        if (candidate.dot(facing) < kSameSide) continue;
        discs.positions.emplace_back(uniform(random), uniform(random), uniform(random));
        discs.normals.push_back(candidate);
        discs.radii.push_back(radius);
    }
    return discs;
}

bool meets(const Vec3f& origin, const Vec3f& direction, const Vec3f& center, const Vec3f& normal, float radius) {
    const float t = normal.dot(center - origin) / normal.dot(direction);
    return (origin + t * direction - center).squaredNorm() < radius * radius;
}

TEST(MergeDisc, RaysHitScatteredDiscsAsOftenAsBefore) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-2, 2);
    std::normal_distribution<float> normal;
    for (const auto& [count, radius] : {std::pair(4, 0.2f), {4, 0.4f}, {8, 0.2f}, {8, 0.4f}}) {
        int before = 0, now = 0;
        for (int group = 0; group < 200; ++group) {
            const MergeDiscs discs = scatteredDiscs(count, radius, random);
            const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
            for (int ray = 0; ray < 1000; ++ray) {
                const Vec3f direction = Vec3f(normal(random), normal(random), normal(random)).normalized();
                const Vec3f u = direction.unitOrthogonal(), v = direction.cross(u);
                const Vec3f origin = Vec3f(0.5f, 0.5f, 0.5f) + uniform(random) * u + uniform(random) * v;
                bool meets_one = false;
                for (const std::uint32_t i : allOf(discs))
                    meets_one |= meets(origin, direction, discs.positions[i], discs.normals[i], discs.radii[i]);
                before += meets_one;
                now += meets(origin, direction, merged.position, merged.normal, merged.radius);
            }
        }
        EXPECT_NEAR(now, before, 0.1 * before)
            << count << " of radius " << radius; // with the sum of the areas, discs would be hit 7 to 20% more often
    }
}

/// Balls at random in a cube of edge 1.
MergeDiscs scatteredBalls(int count, float radius, std::mt19937& random) {
    MergeDiscs balls = scatteredDiscs(count, radius, random);
    for (Vec3f& normal : balls.normals) normal.setZero();
    return balls;
}

TEST(MergeDisc, RaysHitBallsAsOftenAsBefore) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-2, 2);
    std::normal_distribution<float> normal;
    const auto meets_ball = [](const Vec3f& origin, const Vec3f& direction, const Vec3f& center, float radius) {
        return (center - origin).cross(direction).squaredNorm() < radius * radius;
    };
    for (const auto& [count, radius] : {std::pair(2, 0.1f), {4, 0.1f}, {4, 0.2f}, {8, 0.1f}, {8, 0.2f}, {8, 0.3f}}) {
        int before = 0, now = 0;
        for (int group = 0; group < 200; ++group) {
            const MergeDiscs balls = scatteredBalls(count, radius, random);
            const MergedDisc merged = mergeDiscs(balls, allOf(balls), true);
            EXPECT_EQ(merged.normal, Vec3f(Vec3f::Zero()));
            for (int ray = 0; ray < 1000; ++ray) {
                const Vec3f direction = Vec3f(normal(random), normal(random), normal(random)).normalized();
                const Vec3f u = direction.unitOrthogonal(), v = direction.cross(u);
                const Vec3f origin = Vec3f(0.5f, 0.5f, 0.5f) + uniform(random) * u + uniform(random) * v;
                bool meets_one = false;
                for (const std::uint32_t i : allOf(balls))
                    meets_one |= meets_ball(origin, direction, balls.positions[i], balls.radii[i]);
                before += meets_one;
                now += meets_ball(origin, direction, merged.position, merged.radius);
            }
        }
        EXPECT_NEAR(now, before, 0.1 * before) << count << " of radius " << radius;
    }
}

/// No point of the members' surfaces outside the merged ball is farther from it than its error, and no point of the
/// ball is farther than that from the members.
TEST(MergeDisc, ErrorBoundsTheDistanceOfBalls) {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    for (int round = 0; round < 200; ++round) {
        const MergeDiscs balls = scatteredBalls(5, 0.2f, random);
        const MergedDisc merged = mergeDiscs(balls, allOf(balls), true);
        for (int k = 0; k < 200; ++k) {
            const Vec3f direction = Vec3f(normal(random), normal(random), normal(random)).normalized();
            float nearest = 1e9f;
            for (std::size_t i = 0; i < balls.radii.size(); ++i) {
                const Vec3f point = balls.positions[i] + balls.radii[i] * direction;
                EXPECT_LE((point - merged.position).norm() - merged.radius, merged.error + 1e-5f);
                const Vec3f own = merged.position + merged.radius * direction;
                nearest = std::min(nearest, (own - balls.positions[i]).norm() - balls.radii[i]);
            }
            EXPECT_LE(nearest, 1.2f * merged.error); // sampled in fourteen directions
        }
    }
}

TEST(MergeDisc, BallsAndDiscsStayApart) {
    const Vec3f up(0, 0, 1), none = Vec3f::Zero();
    const MergeDiscs both{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {none, up, none, up}, {1, 1, 1, 1}};
    for (const bool oriented : {true, false})
        EXPECT_EQ(groupBySide(both, allOf(both), oriented), (std::vector<std::uint32_t>{0, 1, 0, 1}));
}

TEST(MergeDisc, OneStaysItself) {
    const MergeDiscs discs{{{1, 2, 3}}, {Vec3f(0, 1, 0)}, {0.5f}};
    const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
    EXPECT_EQ(merged.position, discs.positions[0]);
    EXPECT_EQ(merged.radius, 0.5f);
    EXPECT_EQ(merged.error, 0);
}

TEST(MergeDisc, SidesStayApart) {
    const Vec3f up(0, 0, 1), steep(0, 0.8f, 0.6f), level(0, 1, 0);
    const MergeDiscs discs{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {up, -up, steep, level}, {1, 1, 1, 1}};
    EXPECT_EQ(groupBySide(discs, allOf(discs), true), (std::vector<std::uint32_t>{0, 1, 0, 2}));
    EXPECT_EQ(groupBySide(discs, allOf(discs), false), (std::vector<std::uint32_t>{0, 0, 0, 1}));
}

TEST(MergeDisc, SticksAreSplit) {
    MergeDiscs stick;
    for (int i = 0; i < 8; ++i) {
        stick.positions.emplace_back(1.5f * float(i * 5 % 8), 0, 0); // from 0 to 10.5, unsorted
        stick.normals.emplace_back(0, 0, 1);
        stick.radii.push_back(1);
    }
    std::vector<std::uint32_t> members = allOf(stick), sizes;
    splitLong(stick, members, sizes);
    EXPECT_EQ(sizes, (std::vector<std::uint32_t>{2, 2, 2, 2})); // 3.5 long, 2 wide
    for (std::size_t pair = 0; pair < 4; ++pair)
        EXPECT_FLOAT_EQ(std::abs(stick.positions[members[2 * pair]].x() - stick.positions[members[2 * pair + 1]].x()),
                        1.5f);
    MergeDiscs square{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, stick.normals, {1, 1, 1, 1}};
    members = allOf(square);
    sizes.clear();
    splitLong(square, members, sizes);
    EXPECT_EQ(sizes, (std::vector<std::uint32_t>{4}));
}

/// Unoriented normals: the mean of a normal and its opposite is one of the two.
TEST(MergeDisc, AxesDoNotCancel) {
    const Vec3f up(0, 0, 1);
    const MergeDiscs discs{{{0, 0, 0}, {1, 0, 0}}, {up, -up}, {1, 1}};
    EXPECT_NEAR(std::abs(mergeDiscs(discs, allOf(discs), false).normal.z()), 1, 1e-6);
}

/// No point of a member is farther from the merged disc than its error, and no point of the merged disc is farther than
/// that from the members.
TEST(MergeDisc, ErrorBoundsTheDistanceOfRims) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> both(-1, 1);
    for (int round = 0; round < 200; ++round) {
        MergeDiscs discs;
        for (int i = 0; i < 5; ++i) {
            discs.positions.emplace_back(both(random), both(random), 0.3f * both(random));
            discs.normals.push_back(Vec3f(0.4f * both(random), 0.4f * both(random), 1).normalized());
            discs.radii.push_back(0.6f + 0.3f * both(random));
        }
        const MergedDisc merged = mergeDiscs(discs, allOf(discs), true);
        for (std::size_t i = 0; i < 5; ++i) {
            const Vec3f u = discs.normals[i].unitOrthogonal(), v = discs.normals[i].cross(u);
            const float angle = 3.2f * both(random);
            const Vec3f rim = discs.positions[i] + discs.radii[i] * (std::cos(angle) * u + std::sin(angle) * v);
            const Vec3f way = rim - merged.position;
            const float height = way.dot(merged.normal);
            const float beyond = std::max(0.0f, (way - height * merged.normal).norm() - merged.radius);
            EXPECT_LE(std::hypot(height, beyond), merged.error + 1e-5f);
        }
    }
}

} // namespace
} // namespace pointrt
