// SPDX-License-Identifier: Apache-2.0
// Measurements as text, and drawn over pictures.
#include "runtime/scene/measure_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/scene/pinhole.h"

namespace pointrt {
namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr PixelSize kMeasuredPicture{200, 100};
const MeasureUnits kMetres{"m", 1000};

/// A camera that looks down the z axis from 10 units away; there, a picture's half height is 10 units.
Camera camera() {
    Camera camera;
    camera.eye = {0, 0, 10};
    camera.right = {1, 0, 0};
    camera.up = {0, 1, 0};
    camera.forward = {0, 0, -1};
    camera.fov_deg = 90;
    return camera;
}

void expectPlace(const Camera& camera, Vec3 point, double x, double y) {
    const auto place = placeInPicture(camera, kMeasuredPicture, point);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x, x, 1e-9);
    EXPECT_NEAR(place->y, y, 1e-9);
}

/// A picture of the measurements over grey, drawn all rows at once or in bands of this many.
Pixels drawn(const std::vector<MeasureDescription>& measures, const Camera& camera, std::size_t rows = 100) {
    PictureOverlay overlay;
    addMeasures(measures, kMetres, camera, kMeasuredPicture, overlay);
    const std::size_t row = std::size_t{3} * kMeasuredPicture.width;
    Pixels picture(row * kMeasuredPicture.height, 100);
    for (std::size_t first = 0; first < kMeasuredPicture.height; first += rows) {
        const std::size_t count = std::min(rows, kMeasuredPicture.height - first);
        compositeOverlay(overlay,
                         {std::span(picture).subspan(first * row, count * row), kMeasuredPicture.width, first});
    }
    return picture;
}

std::uint8_t redAt(const Pixels& picture, std::size_t x, std::size_t y) {
    return picture[3 * (y * kMeasuredPicture.width + x)];
}

MeasureDescription path(std::vector<Vec3> points) { return {std::move(points)}; }

TEST(Measure, TextHasTheLengthOrTheAreaWithItsUnit) {
    EXPECT_EQ(measuredText(path({{0, 0, 0}, {3, 4, 12}}), kMetres), "13.000 m");
    EXPECT_EQ(measuredText(path({{0, 0, 0}, {3, 4, 12}, {3, 4, 13}}), {"", 1e6}), "14");
    MeasureDescription triangle = path({{600000, 0, 0}, {600003, 0, 0}, {600003, 4, 0}});
    triangle.closed = true;
    EXPECT_EQ(measuredText(triangle, {"ft", 1000}), "6.00 ft2");
    triangle.layer.name = "gable";
    EXPECT_EQ(labelOf(triangle, {"ft", 1000}), "6.00 ft2, gable");
}

TEST(Measure, LabelsAreInTheMiddle) {
    EXPECT_EQ(labelPlace(path({{0, 0, 0}, {1, 0, 0}, {1, 3, 0}})), (Vec3{1, 1, 0})) << "half way along";
    MeasureDescription square = path({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    square.closed = true;
    EXPECT_EQ(labelPlace(square), (Vec3{1, 1, 0}));
    EXPECT_EQ(labelPlace(path({{1, 2, 3}, {1, 2, 3}})), (Vec3{1, 2, 3})) << "without length";
}

TEST(MeasurePicture, PlacesPointsWhereTheCameraSeesThem) {
    expectPlace(camera(), {0, 0, 0}, 100, 50);
    expectPlace(camera(), {10, 5, 0}, 150, 25);
    expectPlace(camera(), {10, 5, -10}, 125, 37.5);
    EXPECT_FALSE(placeInPicture(camera(), kMeasuredPicture, {0, 0, 11})) << "behind the eye";
    Camera parallel = camera();
    parallel.ortho_height = 20;
    expectPlace(parallel, {10, 5, -10}, 150, 25);
}

TEST(MeasurePicture, KnowsCalibratedLenses) {
    const CameraPose pose{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    const Camera lens = pinholeCamera(pose, {80, 90, 70, 40}, kMeasuredPicture);
    expectPlace(lens, {0, 0, 2}, 70, 40);
    expectPlace(lens, {1, 0.5, 2}, 70 + 80 * 0.5, 40 + 90 * 0.25);
}

TEST(MeasurePicture, DrawsLinesBetweenThePoints) {
    const Pixels picture = drawn({path({{-10, 5, 0}, {10, 5, 0}})}, camera());
    // half a pixel from the axis: 0.6 of black over 100, then three quarters of 125
    EXPECT_EQ(redAt(picture, 60, 25), 104);
    EXPECT_LT(redAt(picture, 60, 26), 60) << "the dark line";
    EXPECT_EQ(redAt(picture, 60, 30), 100);
    EXPECT_EQ(redAt(picture, 40, 25), 100) << "before its first point";
    EXPECT_GT(redAt(picture, 50, 25), 240) << "the dot of a point";
}

TEST(MeasurePicture, ClosedOnesReturnToTheirFirstPoint) {
    MeasureDescription triangle = path({{-10, 8, 0}, {10, 8, 0}, {10, -8, 0}});
    EXPECT_EQ(redAt(drawn({triangle}, camera()), 75, 70), 100);
    triangle.closed = true;
    EXPECT_NE(drawn({triangle}, camera()), drawn({path(triangle.points)}, camera()));
    EXPECT_NE(redAt(drawn({triangle}, camera()), 75, 29), 100) << "half way back: (-5, 4)";
}

TEST(MeasurePicture, DoesNotDependOnHowRowsAreAdded) {
    const std::vector<MeasureDescription> measures{path({{-9, 4, 0}, {9, -7, 3}, {2, 9, 1}})};
    for (const std::size_t rows : {1u, 7u}) EXPECT_EQ(drawn(measures, camera(), rows), drawn(measures, camera()));
}

TEST(MeasurePicture, OmitsWhatIsHiddenOrNotInView) {
    const Pixels bare = drawn({}, camera());
    MeasureDescription hidden = path({{-5, 0, 0}, {5, 0, 0}});
    hidden.visible = false;
    EXPECT_EQ(drawn({hidden}, camera()), bare);
    EXPECT_EQ(drawn({path({{0, 0, 20}, {5, 0, 30}})}, camera()), bare) << "behind the eye";
    EXPECT_EQ(drawn({path({{99, 0, 0}, {99, 5, 0}})}, camera()), bare) << "beside the picture";
    EXPECT_NE(drawn({path({{0, -5, 0}, {0, -5, 30}})}, camera()), bare) << "in front in part";
    Camera panorama = camera();
    panorama.panorama = true;
    EXPECT_EQ(drawn({path({{-5, 0, 0}, {5, 0, 0}})}, panorama), bare);
}

} // namespace
} // namespace pointrt
