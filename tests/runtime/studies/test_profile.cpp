// SPDX-License-Identifier: Apache-2.0
// Profiles over a roof on level ground, and points snapped to surfaces.
#include "pointrt/measure.hpp"
#include "runtime/util/vec_array.h"
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

constexpr double kFloor = 0.25, kSlab = 0.5, kSheetStep = 0.01;
/// Bound of the error of heights, in metres: normals are rounded, by 3e-4 of a disc's radius of 1.28 m at its rim.
constexpr double kHeightError = 1e-3;

/// Ground over x, y from 0.1 to 0.9, and a slab above its eastern half.
class ProfileStudy : public Study {
protected:
    ProfileStudy() {
        std::vector<pro_splat> splats;
        addSheet(splats, {{0.1, 0.1, kFloor}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, kSheetStep, kSheetStep);
        addSheet(splats, {{0.5, 0.1, kSlab}, {0.4, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, kSheetStep, kSheetStep);
        scene.emplace(device, std::vector{scan("slab.pro", splats)});
    }

    Position at(double x, double y, double z = 0) const {
        return {place.origin[0] + place.edge * x, place.origin[1] + place.edge * y, place.origin[2] + place.edge * z};
    }
    double height(double z) const { return place.origin[2] + place.edge * z; }
    std::vector<Position> line() const { return {at(0.2, 0.5), at(0.8, 0.5)}; }

    const GridPlace place;
    std::optional<TraceScene> scene;
};

TEST_F(ProfileStudy, TheFirstSurfaceFromAbove) {
    const auto points = surfaceProfile(*scene, line(), {.step = 0.4});
    ASSERT_EQ(points.size(), 193u); // 76.8 m in steps of 0.4 m, and the start
    EXPECT_EQ(points.front().station, 0);
    EXPECT_NEAR(points.back().station, 76.8, 1e-9);
    for (const ProfilePoint& point : points) {
        ASSERT_TRUE(point.hit);
        const double x = (point.position[0] - place.origin[0]) / place.edge;
        if (std::abs(x - 0.5) < kSheetStep) continue; // the slab's edge is a row of discs
        EXPECT_NEAR(point.height, height(x < 0.5 ? kFloor : kSlab), kHeightError) << x;
        EXPECT_NEAR(point.position[0], at(0.2, 0)[0] + point.station, 1e-7);
        EXPECT_EQ(point.height, point.position[2]);
    }
}

TEST_F(ProfileStudy, FromBelowAndFromWithin) {
    const Position east = at(0.7, 0.5), end = at(0.72, 0.5);
    const auto heightFrom = [&](ProfileSide side, std::optional<double> start) {
        return surfaceProfile(*scene, std::vector{east, end}, {.step = 1, .from = side, .start_height = start})[0]
            .height;
    };
    EXPECT_NEAR(heightFrom(ProfileSide::kBelow, {}), height(kFloor), kHeightError);
    EXPECT_NEAR(heightFrom(ProfileSide::kBelow, height(0.3)), height(kSlab), kHeightError) << "the ceiling";
    EXPECT_NEAR(heightFrom(ProfileSide::kAbove, height(0.3)), height(kFloor), kHeightError) << "the floor below it";
}

TEST_F(ProfileStudy, AllSurfacesAreLayers) {
    const auto points = surfaceProfile(*scene, line(), {.step = 0.4, .all = true, .apart = 0.5});
    std::size_t two = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].layer == 0) continue;
        ++two;
        EXPECT_EQ(points[i].layer, 1u);
        EXPECT_EQ(points[i].station, points[i - 1].station);
        EXPECT_NEAR(points[i].height, height(kFloor), kHeightError);
        EXPECT_NEAR(points[i - 1].height, height(kSlab), kHeightError);
    }
    EXPECT_NEAR(static_cast<double>(two), 193 / 2.0, 4); // the eastern half
}

TEST_F(ProfileStudy, GapsHaveNoHeight) {
    const auto points = surfaceProfile(*scene, std::vector{at(0.05, 0.5), at(0.2, 0.5)}, {.step = 0.64});
    EXPECT_FALSE(points.front().hit);
    EXPECT_TRUE(std::isnan(points.front().height));
    EXPECT_TRUE(points.back().hit);
}

TEST_F(ProfileStudy, ABandHasItsMedianAndRange) {
    // across the slab's edge: a third of the band lies on the slab
    const std::vector<Position> along_edge{at(0.5 - 1.0 / 128, 0.4), at(0.5 - 1.0 / 128, 0.6)};
    const auto points = surfaceProfile(*scene, along_edge, {.step = 0.5, .width = 8});
    for (const ProfilePoint& point : points) {
        EXPECT_NEAR(point.height, height(kFloor), kHeightError);
        EXPECT_NEAR(point.low, height(kFloor), kHeightError);
        EXPECT_NEAR(point.high, height(kSlab), kHeightError);
    }
}

TEST_F(ProfileStudy, CornersTurnTheLine) {
    const auto points = surfaceProfile(*scene, std::vector{at(0.2, 0.2), at(0.3, 0.2), at(0.3, 0.3)}, {.step = 6.4});
    ASSERT_EQ(points.size(), 5u);
    EXPECT_NEAR(points[2].position[0], at(0.3, 0)[0], 1e-7);
    EXPECT_NEAR(points[3].position[1], at(0, 0.25)[1], 1e-7);
    EXPECT_NEAR(points[4].station, 25.6, 1e-9);
}

TEST_F(ProfileStudy, BadLinesAreRefused) {
    EXPECT_THROW(surfaceProfile(*scene, std::vector{at(0.2, 0.2, 0.1), at(0.2, 0.2, 0.9)}, {}), TraceError);
    EXPECT_THROW(surfaceProfile(*scene, std::vector{at(0.2, 0.2)}, {}), TraceError);
    EXPECT_THROW(surfaceProfile(*scene, line(), {.step = 1e-7}), TraceError);
    EXPECT_THROW(surfaceProfile(*scene, line(), {.all = true, .width = 1}), TraceError);
}

TEST_F(ProfileStudy, PointsSnapToTheNearestSurface) {
    const std::vector<Position> points{at(0.3, 0.3, kFloor + 0.1), at(0.7, 0.6, kSlab - 0.02), at(0.7, 0.6, kFloor)};
    const std::vector<Position> snapped = snapToSurface(*scene, points);
    const double heights[] = {height(kFloor), height(kSlab), height(kFloor)};
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(snapped[i][0], points[i][0], 0.01) << i;
        EXPECT_NEAR(snapped[i][1], points[i][1], 0.01) << i;
        EXPECT_NEAR(snapped[i][2], heights[i], kHeightError) << i;
    }
    EXPECT_THROW(snapToSurface(*scene, std::vector<Position>{{0, 0, NAN}}), TraceError);
    const std::vector<Position> dropped =
        dropToSurface(*scene, std::vector{at(0.7, 0.6, 0), at(0.05, 0.6, 0)}, {0, 0, 1});
    EXPECT_NEAR(dropped[0][2], height(kSlab), kHeightError);
    EXPECT_NEAR(dropped[0][0], at(0.7, 0)[0], 1e-9);
    EXPECT_TRUE(std::isnan(dropped[1][2])) << "beside the ground";
}

TEST_F(Study, PointsSnapToASphere) {
    const GridPlace place;
    const TraceScene scene(device, {scan("ball.pro", sphereSplats(20000, 0.25f))});
    const Position center{place.origin[0] + 64, place.origin[1] + 64, place.origin[2] + 64};
    const Vec3 out = normalize({1, 2, 3});
    for (const double distance : {20.0, 40.0, 300.0}) {
        const Position point = arrayOf(vectorOf(center) + distance * out);
        const Vec3 snapped = vectorOf(snapToSurface(scene, std::vector{point})[0]);
        // discs of 0.96 m are flat: at their rims they are 14 mm outside
        EXPECT_NEAR(length(snapped - vectorOf(center)), 32, 0.02) << distance;
        EXPECT_NEAR(length(snapped - vectorOf(point)), std::abs(distance - 32), 0.02) << distance;
    }
}

TEST_F(ProfileStudy, ContoursFollowTheSlab) {
    const double between = height((kFloor + kSlab) / 2), cell = 0.5;
    const auto contours = surfaceContours(*scene, {.interval = between, .cell = cell});
    ASSERT_FALSE(contours.empty());
    double along = 0;
    for (const Contour& contour : contours) {
        EXPECT_NEAR(contour.height, between, 1e-9);
        for (const Position& point : contour.points) {
            const double x = (point[0] - place.origin[0]) / place.edge, tolerance = cell / place.edge + kSheetStep;
            EXPECT_NEAR(x, 0.5, tolerance) << "elsewhere the ground ends, and the line with it";
            EXPECT_EQ(point[2], contour.height);
        }
        for (std::size_t i = 1; i < contour.points.size(); ++i)
            along += std::abs(contour.points[i][1] - contour.points[i - 1][1]);
    }
    EXPECT_NEAR(along, 0.8 * place.edge, 0.05 * place.edge);
}

TEST_F(ProfileStudy, ContoursRefuseWhatIsAbsurd) {
    EXPECT_THROW(surfaceContours(*scene, {.cell = 1e-4}), TraceError);
    EXPECT_THROW(surfaceContours(*scene, {.interval = 1e-6, .cell = 1}), TraceError);
    EXPECT_THROW(surfaceContours(*scene, {.interval = -1}), TraceError);
    EXPECT_THROW(surfaceContours(*scene, {.shortest = std::nan("")}), TraceError);
    EXPECT_TRUE(surfaceContours(*scene, {.cell = 1, .shortest = 1e9}).empty());
}

} // namespace
} // namespace pointrt::test
