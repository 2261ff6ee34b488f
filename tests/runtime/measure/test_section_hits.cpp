// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/section_hits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/measure/section_files.h"

namespace pointrt {
namespace {

constexpr double kStep = 0.1;

/// Hits every step along a straight line, with noise across it.
std::vector<SectionHit> row(Vec2 from, Vec2 to, double noise = 0, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> across(0, 1);
    const double size = length(to - from);
    const Vec2 along = (1 / size) * (to - from);
    std::vector<SectionHit> hits;
    for (double at = kStep / 2; at < size; at += kStep)
        hits.push_back({from + at * along + noise * across(random) * Vec2{-along.y, along.x}, along});
    return hits;
}

std::vector<SectionHit> operator+(std::vector<SectionHit> a, const std::vector<SectionHit>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<PlaneLine> linesOf(const std::vector<SectionHit>& hits, double gap = 3 * kStep) {
    std::vector<PlaneLine> lines;
    for (const PlaneLine& line : joinEnds(linkHits(thinHits(hits, kStep), kStep), kStep, gap))
        lines.push_back(simplified(line, kStep / 2));
    return lines;
}

TEST(SectionHits, OfOnePieceAreOne) {
    const auto wall = row({0, 0}, {5, 0});
    EXPECT_EQ(thinHits(wall, kStep).size(), wall.size());
    EXPECT_EQ(thinHits(wall + row({0, 0.05}, {5, 0.05}), kStep).size(), wall.size());
    EXPECT_EQ(thinHits(wall + row({0, 0.15}, {5, 0.15}), kStep).size(), 2 * wall.size()) << "two sheets";
}

TEST(SectionHits, OfARectangleHaveFourCorners) {
    const auto lines = linesOf(row({0, 0}, {3, 0}) + row({3, 0}, {3, 2}) + row({3, 2}, {0, 2}) + row({0, 2}, {0, 0}));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].closed);
    ASSERT_EQ(lines[0].points.size(), 4u);
    EXPECT_NEAR(lengthOf(lines[0]), 10, 1e-9);
}

TEST(SectionHits, PastACornerAreCutOff) {
    const auto lines = linesOf(row({-1, 0}, {0.15, 0}) + row({0, -0.15}, {0, 1})); // an L whose legs cross
    ASSERT_EQ(lines.size(), 1u);
    ASSERT_EQ(lines[0].points.size(), 3u);
    EXPECT_NEAR(length(lines[0].points[1]), 0, 1e-9);
}

TEST(SectionHits, OfTwoFacesStayTwoLines) {
    const auto lines = linesOf(row({0, 0}, {4, 0}) + row({0, 0.3}, {4, 0.3}));
    ASSERT_EQ(lines.size(), 2u) << "a wall of three steps";
    for (const PlaneLine& line : lines) EXPECT_NEAR(lengthOf(line), 4 - kStep, 1e-9);
}

TEST(SectionHits, AreNotJoinedAcrossWideGaps) {
    const auto walls = row({0, 0}, {2, 0}) + row({2.5, 0}, {4, 0});
    EXPECT_EQ(linesOf(walls, 0.5).size(), 2u);
    EXPECT_EQ(linesOf(walls, 0.61).size(), 1u) << "the last hits lie half a step inside";
}

TEST(SectionHits, NoiseDoesNotLengthenLines) {
    const double noise = kStep / 8;
    const auto lines = linesOf(row({0, 0}, {9, 3}, noise, 1) + row({9, 3}, {8, 6}, noise, 2));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].points.size(), 3u);
    EXPECT_NEAR(lengthOf(lines[0]), 4 * std::sqrt(10), kStep + 0.05);
    EXPECT_NEAR(length(lines[0].points[1] - Vec2{9, 3}), 0, noise);
}

TEST(SectionHits, OfACircleCloseIt) {
    std::vector<SectionHit> circle;
    for (int k = 0; k < 126; ++k) {
        const double angle = 2 * std::numbers::pi * k / 126;
        circle.push_back({2 * Vec2{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}});
    }
    const auto lines = linesOf(circle);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_NEAR(lengthOf(lines[0]), 4 * std::numbers::pi, 0.005 * 4 * std::numbers::pi);
}

TEST(SectionHits, AloneAreNoLine) {
    EXPECT_TRUE(linesOf({{{0, 0}, {1, 0}}, {{3, 3}, {0, 1}}}).empty());
    EXPECT_TRUE(linesOf({}).empty());
}

/// No point that is left out of a line lies farther from it than the tolerance.
TEST(SimplifiedLines, KeepTheirTolerance) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> turn(-0.8, 0.8);
    for (int round = 0; round < 200; ++round) {
        PlaneLine line{{{0, 0}}, round % 2 == 1};
        double angle = 0;
        for (int k = 0; k < 60; ++k) {
            angle += turn(random);
            line.points.push_back(line.points.back() + Vec2{std::cos(angle), std::sin(angle)});
        }
        const PlaneLine simple = simplified(line, 0.7);
        EXPECT_LT(simple.points.size(), line.points.size());
        for (const Vec2 point : line.points) {
            double nearest = HUGE_VAL;
            for (std::size_t i = 0; i + 1 < simple.points.size() + (simple.closed ? 1 : 0); ++i)
                nearest = std::min(
                    nearest, distanceToSegment(point, simple.points[i], simple.points[(i + 1) % simple.points.size()]));
            EXPECT_LE(nearest, 0.7 + 1e-12) << round;
        }
    }
}

TEST(SectionFiles, HoldTheLines) {
    SectionDrawing drawing;
    drawing.sections = {{"height 1.2", {{0, 0, 1.2}}, {{true, {{0, 0, 1.2}, {4, 0, 1.2}, {4, 3, 1.2}}}}},
                        {"y=3", {{0, 3, 0}, {1, 0, 0}, {0, 0, 1}}, {{false, {{5, 3, 0}, {5, 3, 2.5}}}}}};
    drawing.unit = "m";
    drawing.epsg = 2056;
    const std::string dxf = sectionDxf(drawing), geo = sectionGeoJson(drawing), svg = sectionSvg(drawing);
    EXPECT_EQ(sectionCsv(drawing), "section,line,x,y,z\n1,1,0.000,0.000,1.200\n1,1,4.000,0.000,1.200\n"
                                   "1,1,4.000,3.000,1.200\n1,1,0.000,0.000,1.200\n"
                                   "2,2,5.000,3.000,0.000\n2,2,5.000,3.000,2.500\n");
    EXPECT_TRUE(sectionCsv(flattened(drawing)).ends_with("2,2,5.000,0.000,0.000\n2,2,5.000,2.500,0.000\n"));
    EXPECT_NE(dxf.find("8\nsection_2"), std::string::npos);
    EXPECT_NE(geo.find("\"section\":2"), std::string::npos) << geo;
    EXPECT_NE(geo.find("2056"), std::string::npos);
    EXPECT_EQ(sectionGeoJson(flattened(drawing)).find("2056"), std::string::npos);
    EXPECT_NE(svg.find("<polygon"), std::string::npos);
    EXPECT_NE(svg.find("height 1.2</text>"), std::string::npos);
    EXPECT_NE(svg.find(" m</text>"), std::string::npos) << "the scale bar";
    EXPECT_EQ(sectionSvg({}).find("nan"), std::string::npos);
}

} // namespace
} // namespace pointrt
