// SPDX-License-Identifier: Apache-2.0
// Cameras with intrinsics and a pose: objects at known places are in the pixels given by the formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "pointrt/render.hpp"
#include "runtime/scene/camera.h"
#include "runtime/scene/pinhole.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

using Vector = std::array<double, 3>;

/// Looks straight down with north up, rotated by 0.3 about its own z and then tilted by 0.4 about x.
PinholeCamera tilted(Vector eye) {
    const double c = std::cos(0.3), s = std::sin(0.3), ct = std::cos(0.4), st = std::sin(0.4);
    // columns: right, down, forward
    const Vector right{c, -s * ct, -s * st}, down{-s, -c * ct, -c * st}, forward{0, st, -ct};
    PinholeCamera camera{300, 280, 20.5, 70.25, {}};
    for (std::size_t row = 0; row < 3; ++row) {
        double* to = camera.world_from_camera.data() + 4 * row;
        to[0] = right[row];
        to[1] = down[row];
        to[2] = forward[row];
        to[3] = eye[row];
    }
    camera.world_from_camera[15] = 1;
    return camera;
}

/// The direction of the ray through a place of the picture, by the camera's definition: 1 along the camera's z.
Vector directionOf(const PinholeCamera& camera, double x, double y) {
    const Vector in_camera{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1};
    Vector direction{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            direction[row] += camera.world_from_camera[4 * row + column] * in_camera[column];
    return direction;
}

/// The place in the picture of a place in the world.
std::array<double, 2> pixelOf(const PinholeCamera& camera, Vector place) {
    Vector in_camera{};
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row)
            in_camera[column] +=
                camera.world_from_camera[4 * row + column] * (place[row] - camera.world_from_camera[4 * row + 3]);
    return {camera.cx + camera.fx * in_camera[0] / in_camera[2], camera.cy + camera.fy * in_camera[1] / in_camera[2]};
}

TEST(MachineCameras, DepthsAgreeWithAPlane) {
    const TemporaryFolder folder;
    writeScan(folder.file("plane.pro"), planeSplats(40, 0.5f), {}); // at z = 164
    const TraceDevice device;
    PictureRenderer renderer(device, {folder.file("plane.pro")});
    const PinholeCamera camera = tilted({500064, 4500055, 200});
    const std::uint32_t width = 80, height = 60;
    const Picture picture = renderer.render(camera, width, height, {"depth"});
    const std::vector<float>& depth = picture.layer("depth").floats;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const Vector direction = directionOf(camera, x + 0.5, y + 0.5);
            const double length = std::hypot(direction[0], direction[1], direction[2]);
            ASSERT_NEAR(depth[y * width + x], -36 / direction[2] * length, 2e-3) << x << " " << y;
        }
}

TEST(MachineCameras, PointsProjectToTheirPixels) {
    const TemporaryFolder folder;
    const GridPlace place{{500058, 4500052, 156}, 16};
    // discs of 0.1 m that face the sky
    std::vector<pro_splat> splats;
    const float spots[][2] = {{0.375f, 0.43f}, {0.45f, 0.51f}, {0.54f, 0.59f}, {0.61f, 0.43f}};
    for (const auto& spot : spots) splats.push_back({{spot[0], spot[1], 0.5f}, {0, 0, 1}, 0.1f / 16, {255, 0, 0}, 0});
    writeScan(folder.file("spots.pro"), splats, place);
    const TraceDevice device;
    PictureRenderer renderer(device, {folder.file("spots.pro")}, {{"lights", "1"}});
    const std::uint32_t width = 640, height = 480;
    PinholeCamera camera = tilted({500064, 4500045, 200});
    camera.fx = 2400, camera.fy = 2200, camera.cx = 100, camera.cy = 300;
    const Picture picture = renderer.render(camera, width, height, {"splat_id"});
    const std::vector<std::uint32_t>& ids = picture.layer("splat_id").words;
    for (const pro_splat& splat : splats) {
        const auto at = pixelOf(camera, place.world(splat.position));
        const std::uint32_t number = ids.at(width * static_cast<std::size_t>(at[1]) + static_cast<std::size_t>(at[0]));
        ASSERT_NE(number, kNoHit);
        double sum_x = 0, sum_y = 0, count = 0;
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                if (ids[y * width + x] == number) sum_x += x + 0.5, sum_y += y + 0.5, ++count;
        ASSERT_GT(count, 30); // a radius of 6 pixels
        // the index of so sparse a cube rounds discs by some millimetres, a fifth of a pixel here
        EXPECT_NEAR(sum_x / count, at[0], 0.3);
        EXPECT_NEAR(sum_y / count, at[1], 0.3);
    }
}

TEST(MachineCameras, CentredPinholesAgreeWithAFieldOfView) {
    const Camera looked =
        frameCamera({.eye = Vec3{1, 2, 3}, .target = Vec3{1, 2, 9}, .up = Vec3{0, -1, 0}, .fov_deg = 50}, {0, 0, 0},
                    {10, 10, 10}, 2);
    const double focal = 100 / (2 * std::tan(verticalHalfAngle(50)));
    const Camera machine = pinholeCamera({.eye = {1, 2, 3}}, {focal, focal, 100, 50}, {200, 100});
    EXPECT_EQ(machine.eye, looked.eye);
    EXPECT_EQ(machine.forward, looked.forward);
    EXPECT_EQ(machine.right, looked.right);
    EXPECT_EQ(machine.up, looked.up);
    EXPECT_NEAR(machine.fov_deg, 50, 1e-12);
}

TEST(MachineCameras, SmallRotationErrorsAreCorrected) {
    CameraPose pose;
    pose.right = {0.9996, 2e-4, 0};
    pose.forward = {3e-4, 0, 1.0004};
    const Camera camera = pinholeCamera(pose, {50, 50, 50, 50}, {100, 100});
    EXPECT_NEAR(length(camera.right), 1, 1e-15);
    EXPECT_NEAR(dot(camera.right, camera.forward), 0, 1e-15);
    EXPECT_NEAR(length(camera.up), 1, 1e-15);
}

TEST(MachineCameras, RefusesInvalidCameras) {
    const PinholeLens lens{50, 50, 50, 50};
    const auto camera = [](const CameraPose& pose, const PinholeLens& with) {
        return pinholeCamera(pose, with, {100, 100});
    };
    EXPECT_NO_THROW(camera({}, lens));
    EXPECT_THROW(camera({.right = {-1, 0, 0}}, lens), std::invalid_argument);   // mirrored
    EXPECT_THROW(camera({.right = {1.01, 0, 0}}, lens), std::invalid_argument); // scaled
    EXPECT_THROW(camera({.right = {0, 1, 0}}, lens), std::invalid_argument);
    EXPECT_THROW(camera({.eye = {NAN, 0, 0}}, lens), std::invalid_argument);
    EXPECT_THROW(camera({}, {0, 50, 50, 50}), std::invalid_argument);
    EXPECT_THROW(camera({}, {50, -50, 50, 50}), std::invalid_argument);
    EXPECT_THROW(camera({}, {50, 50, INFINITY, 50}), std::invalid_argument);
    EXPECT_THROW(camera({}, {1e9, 1e9, 50, 50}), std::invalid_argument);
    EXPECT_THROW(camera({}, {50, 50, 1e9, 50}), std::invalid_argument);
}

} // namespace
} // namespace pointrt::test
