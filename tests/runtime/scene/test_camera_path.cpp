// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/camera_path.h"

#include <gtest/gtest.h>

#include <vector>

namespace pointrt {
namespace {

/// A camera at x that looks along y, with z up.
Camera cameraAt(double x) { return {{x, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 40 + x, 0}; }

void expectSamePlace(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12); }

TEST(CameraPath, PassesItsKeysExactly) {
    std::vector<Camera> keys{cameraAt(0), cameraAt(1), cameraAt(5)};
    keys[1].ortho_height = 3;
    for (std::size_t key = 0; key < keys.size(); ++key)
        EXPECT_EQ(cameraOnPath(keys, static_cast<double>(key)), keys[key]);
    EXPECT_EQ(cameraOnPath(std::vector{keys[1]}, 0), keys[1]);
}

TEST(CameraPath, IsStraightAndEvenBetweenEvenKeys) {
    const std::vector<Camera> keys{cameraAt(0), cameraAt(2), cameraAt(4)};
    const Camera camera = cameraOnPath(keys, 0.75);
    expectSamePlace(camera.eye, {1.5, 0, 0});
    expectSamePlace(camera.forward, {0, 1, 0});
    EXPECT_NEAR(camera.fov_deg, 41.5, 1e-12);
}

TEST(CameraPath, HasNoCornerAtAKey) {
    std::vector<Camera> keys{cameraAt(0), cameraAt(1), cameraAt(1)};
    keys[2].eye = {1, 1, 0};
    constexpr double step = 1e-6;
    const Vec3 before = keys[1].eye - cameraOnPath(keys, 1 - step).eye;
    const Vec3 after = cameraOnPath(keys, 1 + step).eye - keys[1].eye;
    EXPECT_LT(length(after - before), 1e-9) << "half of the way from the first key to the third, at each";
    EXPECT_NEAR(length(after) / step, std::sqrt(0.5), 1e-4);
}

TEST(CameraPath, TurnsAndZooms) {
    std::vector<Camera> keys{cameraAt(0), cameraAt(0)};
    keys[1].forward = {1, 0, 0};
    keys[1].right = {0, -1, 0};
    keys[0].ortho_height = 1;
    keys[1].ortho_height = 16;
    const Camera camera = cameraOnPath(keys, 0.5);
    expectSamePlace(camera.forward, normalize(Vec3{1, 1, 0}));
    expectSamePlace(camera.up, {0, 0, 1});
    expectSamePlace(camera.right, normalize(Vec3{1, -1, 0}));
    EXPECT_NEAR(camera.ortho_height, 4, 1e-12);
}

} // namespace
} // namespace pointrt
