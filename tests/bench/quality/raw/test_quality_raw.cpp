// SPDX-License-Identifier: Apache-2.0
// Pictures of known surfaces with known errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "tests/bench/quality/raw/picture_errors.h"
#include "tests/bench/quality/raw/raw_report.h"
#include "tests/bench/quality/shapes.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::quality {

namespace {

Mesh meshOf(const std::string& shape) {
    const std::string path = test::temporaryPath(shape + ".ply");
    writeMesh(path, makeShape(shape).mesh);
    Mesh mesh = loadMesh(path);
    std::filesystem::remove(path);
    return mesh;
}

/// The unit sphere from a distance of 4: its silhouette is a circle of half the picture.
constexpr int kSize = 256;
const Pinhole kCamera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 60, kSize};

/// A sphere as truth, with its vertices as raw points.
struct Ball {
    Mesh mesh = meshOf("sphere");
    Tracing tracing{mesh};
    RawPoints raw{mesh.positions};
    UnitCamera camera{kCamera, mesh.frame};
    Sights truth = castMesh(mesh, tracing, camera);
    /// Tolerance and reach are in radii of the truth's bounding box.
    PictureTruth against{tracing, raw, 0.01f, 0.1f};

    AllAndSeen errorsOf(const Sights& picture) const { return compareSights(truth, picture, camera, against); }
};

std::size_t middle() { return static_cast<std::size_t>(kSize / 2) * (kSize + 1); }

TEST(CameraTest, RaysOfTheCornersAreHalfTheFieldOfViewApart) {
    const Pinhole camera{{1, 2, 3}, {1, 2, 0}, {0, 1, 0}, 90, 1000};
    const PinholeRays rays(camera);
    const Vec3d first = rays.direction(0, 0); // 45 degrees to the left and up, less half a pixel
    EXPECT_NEAR(first.x() / first.z(), 0.999, 1e-9);
    EXPECT_NEAR(first.y() / first.z(), -0.999, 1e-9);
}

TEST(SightsTest, SphereIsSeenWhereItIs) {
    const Ball ball;
    const Sight& sight = ball.truth[middle()];
    EXPECT_NEAR(sight.t * ball.mesh.frame.radius, 3, 1e-3);
    EXPECT_NEAR(sight.normal.z(), 1, 1e-3);
    // seen under asin(1/4), a disc of (tan(asin(1/4)) / tan(30 degrees) * 128)^2 pi pixels
    const double radius = std::tan(std::asin(0.25)) / std::tan(std::numbers::pi / 6) * kSize / 2;
    EXPECT_NEAR(static_cast<double>(ball.errorsOf(ball.truth).all.truth), std::numbers::pi * radius * radius,
                0.01 * radius * radius);
}

TEST(PictureErrorsTest, TruthIsWithoutError) {
    const Ball ball;
    const auto figures = figuresOf(ball.errorsOf(ball.truth).seen);
    EXPECT_EQ(figures.at("outline_iou"), 1);
    for (const char* none : {"normal_mean", "depth_off", "holes_per_million", "false_surface", "floating"})
        EXPECT_LT(figures.at(none).get<double>(), 1e-4) << none;
}

TEST(PictureErrorsTest, HolesCountInsideOnly) {
    const Ball ball;
    Sights picture = ball.truth;
    picture[middle()] = {};
    std::size_t edge = static_cast<std::size_t>(kSize / 2) * kSize;
    while (!ball.truth[edge].hit()) ++edge;
    picture[edge] = {}; // on the silhouette
    const PictureErrors errors = ball.errorsOf(picture).all;
    EXPECT_EQ(errors.holes, 1u);
    EXPECT_EQ(errors.either - errors.both, 2u);
}

TEST(PictureErrorsTest, DepthIsOffBeyondTheTolerance) {
    const Ball ball;
    Sights picture = ball.truth;
    picture[middle()].t += 0.009f;
    picture[middle() + 1].t -= 0.011f;
    EXPECT_EQ(ball.errorsOf(picture).all.depth_off, 1u);
}

TEST(PictureErrorsTest, NormalErrorsAreUnsigned) {
    const Ball ball;
    Sights picture = ball.truth;
    for (Sight& sight : picture) // rotated by 10 degrees about an axis perpendicular to the normal, and flipped
        sight.normal =
            -(Eigen::AngleAxisf(std::numbers::pi_v<float> / 18, sight.normal.unitOrthogonal()) * sight.normal);
    const auto figures = figuresOf(ball.errorsOf(picture).all);
    EXPECT_NEAR(figures.at("normal_mean").get<double>(), 10, 0.01);
    EXPECT_NEAR(figures.at("normal_p99").get<double>(), 10, 0.01);
}

TEST(PictureErrorsTest, FalseSurfaceIsThreeSpacingsInFront) {
    const Ball ball;
    const float spacing = ball.raw.spacingAt(ball.camera.place(middle(), ball.truth[middle()].t));
    Sights picture = ball.truth;
    picture[middle()].t -= 2.9f * spacing;
    picture[middle() + 1].t -= 3.2f * spacing;
    picture[middle() + 2].t += 10 * spacing; // behind: may be a hole, but not a false surface
    picture[0].t = ball.truth[middle()].t;   // in the empty space beside it
    const PictureErrors errors = ball.errorsOf(picture).all;
    EXPECT_EQ(errors.false_surface, 2u);
    EXPECT_EQ(errors.floating, 2u);
}

TEST(PictureErrorsTest, UnscannedPixelsAreNotCountedAsSeen) {
    Ball ball;
    std::vector<Vec3f> half;
    for (const Vec3f& position : ball.mesh.positions)
        if (position.x() < 0) half.push_back(position);
    const RawPoints raw(half);
    const PictureTruth against{ball.tracing, raw, 0.01f, 0.02f};
    const AllAndSeen errors = compareSights(ball.truth, ball.truth, ball.camera, against);
    EXPECT_NEAR(static_cast<double>(errors.seen.truth) / static_cast<double>(errors.all.truth), 0.5, 0.05);
}

TEST(RawPointsTest, SpacingIsThatOfTheGrid) {
    std::vector<Vec3f> grid;
    for (int x = 0; x < 50; ++x)
        for (int y = 0; y < 50; ++y)
            grid.emplace_back(0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y), 0.f);
    EXPECT_NEAR(RawPoints(grid).spacingAt({0.25f, 0.25f, 0.1f}), 0.01, 0.002);
}

} // namespace

} // namespace pointrt::quality
