// SPDX-License-Identifier: Apache-2.0
// Lines in which planes cut a room with a pillar, a cylinder and a level plane.
#include <algorithm>

#include "pointrt/measure.hpp"
#include "runtime/util/vec_array.h"
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

/// Spacing of points on a surface, in cube units: 0.64 m.
constexpr double kSpacing = 0.005;

double lengthOf(const SectionLine& line) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < line.points.size() + (line.closed ? 1 : 0); ++i)
        sum += length(vectorOf(line.points[(i + 1) % line.points.size()]) - vectorOf(line.points[i]));
    return sum;
}

double lengthOf(const std::vector<SectionLine>& lines) {
    double sum = 0;
    for (const SectionLine& line : lines) sum += lengthOf(line);
    return sum;
}

class SectionStudy : public Study {
protected:
    Position at(double x, double y, double z) const {
        return {place.origin[0] + place.edge * x, place.origin[1] + place.edge * y, place.origin[2] + place.edge * z};
    }
    double height(double z) const { return place.origin[2] + place.edge * z; }
    double spacing() const { return place.edge * kSpacing; }
    /// The rules that pointrt-rays uses for discs with a radius of one spacing.
    SectionRules rules() const { return {spacing() / 2, 3 * spacing(), spacing() / 4, 0}; }
    std::vector<SectionLine> level(double z) const { return sectionLines(*scene, levelPlane(height(z), kUp), rules()); }

    static constexpr Position kUp{0, 0, 1};
    const GridPlace place;
    std::optional<TraceScene> scene;
};

/// Walls around x from 0.2 to 0.8 and y from 0.3 to 0.7, and a pillar of 0.08 by 0.12 in it; floor and roof.
class RoomSection : public SectionStudy {
protected:
    RoomSection() {
        std::vector<pro_splat> splats;
        addBox(splats, {0.2, 0.3, 0.4}, {0.6, 0.4, 0.2}, kSpacing, kSpacing * 0.75);
        addBox(splats, {0.45, 0.44, 0.4}, {0.08, 0.12, 0.2}, kSpacing, kSpacing * 0.75);
        addSheet(splats, {{0.2, 0.3, 0.4}, {0.6, 0, 0}, {0, 0.4, 0}, {0, 0, 1}}, kSpacing, kSpacing * 0.75);
        scene.emplace(device, std::vector{scan("room.pro", splats)});
    }

    /// The distance of a corner of the plan from the nearest point of a line.
    double farFrom(const std::vector<SectionLine>& lines, const Position& corner) const {
        double nearest = HUGE_VAL;
        for (const SectionLine& line : lines)
            for (const Position& point : line.points)
                nearest = std::min(nearest, length(vectorOf(point) - vectorOf(corner)));
        return nearest;
    }
};

TEST_F(RoomSection, AFloorPlanHasTheCornersOfWallsAndPillar) {
    const std::vector<SectionLine> lines = level(0.5);
    ASSERT_EQ(lines.size(), 2u) << "the walls and the pillar";
    for (const SectionLine& line : lines) {
        EXPECT_TRUE(line.closed);
        EXPECT_EQ(line.points.size(), 4u);
    }
    for (const double x : {0.2, 0.8})
        for (const double y : {0.3, 0.7}) EXPECT_LT(farFrom(lines, at(x, y, 0.5)), 0.2 * spacing()) << x << " " << y;
    for (const double x : {0.45, 0.53})
        for (const double y : {0.44, 0.56}) EXPECT_LT(farFrom(lines, at(x, y, 0.5)), 0.2 * spacing()) << x << " " << y;
    EXPECT_NEAR(lengthOf(lines), place.edge * (2 + 0.4), 0.002 * place.edge);
}

TEST_F(RoomSection, AnUprightSectionHasFloorWallsAndRoof) {
    const SectionPlane plane = sectionPlane("y=4500064", kUp); // through the pillar
    const std::vector<SectionLine> lines = sectionLines(*scene, plane, rules());
    EXPECT_NEAR(lengthOf(lines), place.edge * (2 * 0.6 + 4 * 0.2), 0.01 * place.edge);
    for (const SectionLine& line : lines)
        for (const Position& point : line.points) EXPECT_NEAR(point[1], 4500064, 1e-6);
    EXPECT_LT(farFrom(lines, at(0.2, 0.5, 0.6)), spacing());
    EXPECT_LT(farFrom(lines, at(0.8, 0.5, 0.4)), spacing());
}

TEST_F(RoomSection, ObliquePlanesCutLongerLines) {
    // 3:4:5 across the corner of the room at x 0.2, y 0.3
    const Position from = at(0.2 + 0.12, 0.3, 0), to = at(0.2, 0.3 + 0.16, 0);
    const std::string text = std::to_string(from[0]) + "," + std::to_string(from[1]) + "," + std::to_string(to[0]) +
                             "," + std::to_string(to[1]);
    const std::vector<SectionLine> lines = sectionLines(*scene, sectionPlane(text, kUp), rules());
    EXPECT_NEAR(lengthOf(lines), place.edge * (2 * 0.2 + 2 * 0.2), 0.01 * place.edge) << "two walls, floor and roof";
    EXPECT_LT(farFrom(lines, {from[0], from[1], height(0.6)}), spacing());
}

TEST_F(RoomSection, ShortLinesCanBeLeftOut) {
    SectionRules rules = this->rules();
    rules.shortest = place.edge;
    const auto lines = sectionLines(*scene, levelPlane(height(0.5), kUp), rules);
    ASSERT_EQ(lines.size(), 1u) << "the pillar is 51 m around";
    EXPECT_NEAR(lengthOf(lines), 2 * place.edge, 0.002 * place.edge);
}

TEST_F(RoomSection, PlanesBesideTheRoomOrAlongTheFloorHaveNoLines) {
    EXPECT_TRUE(level(0.9).empty());
    for (const SectionLine& line : level(0.4)) // the floor itself gives no line; the walls may begin there
        for (const Position& point : line.points) {
            const double x = (point[0] - place.origin[0]) / place.edge, y = (point[1] - place.origin[1]) / place.edge;
            const bool on_pillar = x > 0.44 && x < 0.54 && y > 0.43 && y < 0.57;
            EXPECT_TRUE(on_pillar || std::min({std::abs(x - 0.2), std::abs(x - 0.8), std::abs(y - 0.3),
                                               std::abs(y - 0.7)}) < kSpacing)
                << x << " " << y;
        }
}

TEST_F(RoomSection, BadRulesAreRefused) {
    const SectionPlane plane = levelPlane(height(0.5), kUp);
    EXPECT_THROW(sectionLines(*scene, plane, {}), TraceError) << "no step";
    EXPECT_THROW(sectionLines(*scene, plane, {.step = 1e-6}), TraceError) << "too many rays";
    EXPECT_THROW(sectionLines(*scene, plane, {.step = 1, .gap = -1}), TraceError);
    EXPECT_THROW(sectionLines(*scene, {{}, {1, 0, 0}, {1, 0, 0}}, {.step = 1}), TraceError);
    EXPECT_THROW(levelPlane(NAN, kUp), TraceError);
    EXPECT_THROW(sectionPlane("w=3", kUp), TraceError);
    EXPECT_THROW(sectionPlane("z=3:0.5", kUp), TraceError) << "a thickness";
}

/// A wall with a doorway of 2 m and a chink of 1 m; points are 0.64 m apart.
TEST_F(SectionStudy, GapsAreJoinedOnlyUpToTheLimit) {
    std::vector<pro_splat> splats;
    const auto addWall = [&](double from, double to) {
        addSheet(splats, {{from, 0.5, 0.4}, {to - from, 0, 0}, {0, 0, 0.2}, {0, 1, 0}}, kSpacing, kSpacing * 0.75);
    };
    addWall(0.2, 0.4);
    addWall(0.4 + 1.0 / 128, 0.6);
    addWall(0.6 + 2.0 / 128, 0.8);
    scene.emplace(device, std::vector{scan("wall.pro", splats)});
    SectionRules rules = this->rules();
    rules.gap = 1 + spacing() / 2; // rays are half a spacing apart
    const auto lines = sectionLines(*scene, levelPlane(height(0.5), kUp), rules);
    ASSERT_EQ(lines.size(), 2u) << "the chink is closed, the doorway is not";
    EXPECT_NEAR(lengthOf(lines), 0.6 * place.edge - 2, spacing());
    rules.gap = 2 + spacing() / 2;
    EXPECT_EQ(sectionLines(*scene, levelPlane(height(0.5), kUp), rules).size(), 1u);
}

TEST_F(SectionStudy, ACylinderIsACircle) {
    constexpr double kRadius = 0.2;
    std::vector<pro_splat> splats;
    const int around = static_cast<int>(2 * std::numbers::pi * kRadius / kSpacing);
    for (int ring = 0; ring < 40; ++ring)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / around;
            const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
            splats.push_back({{0.5f + static_cast<float>(kRadius) * x, 0.5f + static_cast<float>(kRadius) * y,
                               0.4f + static_cast<float>(kSpacing) * static_cast<float>(ring)},
                              {x, y, 0},
                              static_cast<float>(kSpacing),
                              {},
                              0});
        }
    scene.emplace(device, std::vector{scan("cylinder.pro", splats)});
    const std::vector<SectionLine> lines = level(0.5);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_NEAR(lengthOf(lines), 2 * std::numbers::pi * kRadius * place.edge, 0.002 * kRadius * place.edge * 6.28);
    for (const Position& point : lines[0].points)
        EXPECT_NEAR(std::hypot(point[0] - at(0.5, 0, 0)[0], point[1] - at(0, 0.5, 0)[1]), kRadius * place.edge,
                    spacing() / 4);
    EXPECT_LT(lines[0].points.size(), 120u) << "simplified: 251 points lie around the circle";
}

TEST_F(SectionStudy, ALevelPlaneIsOneLineUpright) {
    scene.emplace(device, std::vector{scan("plane.pro", planeSplats(160, 0.5f))});
    const auto lines = sectionLines(*scene, sectionPlane("x=500064", kUp), rules());
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].points.size(), 2u);
    EXPECT_NEAR(lengthOf(lines), 0.8 * place.edge, 2 * spacing());
    EXPECT_TRUE(level(0.5).empty()) << "in the plane itself";
}

TEST(SectionPlanes, HaveTheAxesOfPictures) {
    const Position z_up{0, 0, 1};
    const SectionPlane plan = sectionPlane("z=1.2", z_up), south = sectionPlane("y=3", z_up);
    EXPECT_EQ(plan.right, (Position{1, 0, 0}));
    EXPECT_EQ(plan.up, (Position{0, 1, 0}));
    EXPECT_EQ(plan.point, (Position{0, 0, 1.2}));
    EXPECT_EQ(south.right, (Position{1, 0, 0}));
    EXPECT_EQ(south.up, z_up);
    EXPECT_EQ(sectionPlane("-y=3", z_up).right, (Position{-1, 0, 0}));
    const SectionPlane across = sectionPlane("10,20,10,30", z_up);
    EXPECT_EQ(across.right, (Position{0, 1, 0}));
    EXPECT_EQ(across.point, (Position{10, 20, 0}));
    EXPECT_EQ(levelPlane(2, {0, 1, 0}).point, (Position{0, 2, 0}));
}

} // namespace
} // namespace pointrt::test
