// SPDX-License-Identifier: Apache-2.0
// Visibility over a wall on level ground, checked against the formula.
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

constexpr double kSightGround = 0.25, kSightSpacing = 0.8 / 120, kWall = 0.55, kSightHeight = 0.05;

class Sight : public Study {
protected:
    Sight() {
        std::vector<pro_splat> splats;
        addSheet(splats, {{0.1, 0.1, kSightGround}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, kSightSpacing,
                 0.8 * kSightSpacing);
        // a wall across the ground: two sheets 4 spacings apart
        for (const double x : {kWall, kWall + 4 * kSightSpacing})
            addSheet(splats,
                     {{x, 0.1, kSightGround}, {0, 0.8, 0}, {0, 0, kSightHeight}, {x > kWall ? 1.0f : -1.0f, 0, 0}},
                     kSightSpacing / 2, 0.36 * kSightSpacing);
        addSheet(splats, {{kWall, 0.1, kSightGround + kSightHeight}, {4 * kSightSpacing, 0, 0}, {0, 0.8, 0}, {0, 0, 1}},
                 kSightSpacing / 2, 0.36 * kSightSpacing);
        path = scan("wall.pro", splats);
        points = scanPoints(path);
    }

    double cube(std::size_t point, std::size_t axis) const {
        return (points.positions[3 * point + axis] - place.origin[axis]) / place.edge;
    }
    std::array<double, 3> eyeAt(double x, double y, double z) const {
        return {place.origin[0] + place.edge * x, place.origin[1] + place.edge * y, place.origin[2] + place.edge * z};
    }
    std::vector<std::uint8_t> seenFrom(const Observer& observer, Sides sides = Sides::kFront) {
        const TraceScene scene(device, {path});
        std::vector<std::uint8_t> visible(points.radii.size());
        testSight(scene, points.rows(), observer, {.sides = sides}, visible);
        return visible;
    }

    const GridPlace place;
    std::string path;
    ScanPoints points;
};

TEST_F(Sight, ShadowOfTheWallMatchesTheFormula) {
    const double up = 0.1;
    const auto visible = seenFrom({eyeAt(0.2, 0.5, kSightGround + up)});
    // where the line of sight over the far edge of the wall reaches the ground
    const double far_edge = kWall + 4 * kSightSpacing;
    const double hidden_to = 0.2 + (far_edge - 0.2) * up / (up - kSightHeight);
    std::size_t before = 0, behind = 0, beyond = 0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        if (cube(i, 2) > kSightGround + 1e-4) continue;
        const double x = cube(i, 0);
        if (x < kWall - kSightSpacing) {
            ASSERT_EQ(visible[i], 1) << x << " " << cube(i, 1);
            ++before;
        } else if (x > far_edge + kSightSpacing && x < hidden_to - kSightSpacing) {
            ASSERT_EQ(visible[i], 0) << x << " " << cube(i, 1);
            ++behind;
        } else if (x > hidden_to + kSightSpacing) {
            ASSERT_EQ(visible[i], 1) << x << " " << cube(i, 1);
            ++beyond;
        }
    }
    EXPECT_GT(before, 5000u);
    EXPECT_GT(behind, 1000u);
    ASSERT_GT(hidden_to, 0.9) << "all of the ground behind the wall is hidden";
    EXPECT_EQ(beyond, 0u);
}

TEST_F(Sight, HighObserversSeeTheGroundBeyondTheWall) {
    const double up = 0.5;
    const auto visible = seenFrom({eyeAt(0.2, 0.5, kSightGround + up)});
    const double far_edge = kWall + 4 * kSightSpacing, hidden_to = 0.2 + (far_edge - 0.2) * up / (up - kSightHeight);
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        if (cube(i, 2) > kSightGround + 1e-4 || cube(i, 0) < far_edge + kSightSpacing) continue;
        if (std::abs(cube(i, 0) - hidden_to) < kSightSpacing) continue;
        ASSERT_EQ(visible[i], cube(i, 0) > hidden_to) << cube(i, 0) << " " << cube(i, 1);
        beyond += visible[i];
    }
    EXPECT_GT(beyond, 3000u);
}

TEST_F(Sight, OnlyTheNearSideOfAWallIsSeen) {
    const auto visible = seenFrom({eyeAt(0.2, 0.5, kSightGround + 0.02)});
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const float nx = points.normals[3 * i];
        if (std::abs(nx) < 0.5f) continue;
        ASSERT_EQ(visible[i], nx < 0) << cube(i, 1) << " " << cube(i, 2);
    }
}

TEST_F(Sight, RadiusAndEnclosedObserversLimitSight) {
    const auto near = seenFrom({eyeAt(0.2, 0.5, kSightGround + 0.1), 0.15 * place.edge});
    for (std::size_t i = 0; i < near.size(); ++i) {
        const double distance = std::hypot(cube(i, 0) - 0.2, cube(i, 1) - 0.5, cube(i, 2) - kSightGround - 0.1);
        if (std::abs(distance - 0.15) < 0.001) continue;
        ASSERT_EQ(near[i], distance < 0.15) << distance;
    }
    const auto within = seenFrom({eyeAt(kWall + 2 * kSightSpacing, 0.5, kSightGround + kSightHeight / 2)});
    const auto below = seenFrom({eyeAt(0.3, 0.5, kSightGround - 0.01)});
    for (std::size_t i = 0; i < within.size(); ++i) {
        const bool is_wall = std::abs(cube(i, 0) - kWall - 2 * kSightSpacing) < 4 * kSightSpacing;
        ASSERT_EQ(within[i] != 0 && !is_wall, false) << cube(i, 0) << " " << cube(i, 1);
        ASSERT_EQ(below[i], 0) << cube(i, 0) << " " << cube(i, 1);
    }
}

TEST_F(Sight, AnObserverAtAPointSeesIt) {
    const std::array<double, 3> eye{points.positions[0], points.positions[1], points.positions[2]};
    EXPECT_EQ(seenFrom({eye})[0], 1);
}

TEST_F(Sight, InvalidObserversAreRefused) {
    EXPECT_THROW(seenFrom({{0, std::nan(""), 0}}), TraceError);
    EXPECT_THROW(seenFrom({{0, 0, 0}, 0}), TraceError);
    EXPECT_THROW(seenFrom({{0, 0, 0}, std::nan("")}), TraceError);
}

} // namespace
} // namespace pointrt::test
