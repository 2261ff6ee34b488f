// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/panorama.h"

#include <gtest/gtest.h>

#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

constexpr Vec3 kEye{10, -20, 3};

/// A camera that looks along +Y with +Z up, so that +X is on the right.
Camera northwards(double eyes_apart = 0) {
    Camera camera;
    camera.eye = kEye;
    camera.right = {1, 0, 0};
    camera.forward = {0, 1, 0};
    camera.up = {0, 0, 1};
    camera.panorama = true;
    camera.eyes_apart = eyes_apart;
    return camera;
}

void expectRay(const PanoramaRay& ray, Vec3 origin, Vec3 direction) {
    EXPECT_LT(length(ray.origin - origin), 1e-12);
    EXPECT_LT(length(ray.direction - direction), 1e-12);
}

TEST(Panorama, ColumnsAreLongitudesAndRowsLatitudes) {
    const double s = std::sqrt(0.5);
    expectRay(panoramaRay(northwards(), 0.5, 0.5), kEye, {0, 1, 0});
    expectRay(panoramaRay(northwards(), 0.75, 0.5), kEye, {1, 0, 0});
    expectRay(panoramaRay(northwards(), 0.25, 0.5), kEye, {-1, 0, 0});
    expectRay(panoramaRay(northwards(), 0.5, 0.25), kEye, {0, s, s});
    expectRay(panoramaRay(northwards(), 0.75, 0.75), kEye, {s, 0, -s});
    expectRay(panoramaRay(northwards(), 0.3, 0), kEye, {0, 0, 1});
    expectRay(panoramaRay(northwards(), 0.9, 1), kEye, {0, 0, -1});
}

TEST(Panorama, ItsLeftAndRightEdgesMeetBehindTheEye) {
    for (const double down : {0.1, 0.5, 0.8}) {
        const PanoramaRay left = panoramaRay(northwards(), 0, down), right = panoramaRay(northwards(), 1, down);
        EXPECT_LT(length(left.direction - right.direction), 1e-12);
    }
    expectRay(panoramaRay(northwards(), 0, 0.5), kEye, {0, -1, 0});
}

/// In the middle of either half the eyes are as far apart as requested, perpendicular to the view direction; at the
/// poles they coincide.
TEST(Panorama, InStereoTheEyesTurnWithTheHead) {
    const Camera camera = northwards(0.06);
    expectRay(panoramaRay(camera, 0.5, 0.25), kEye - Vec3{0.03, 0, 0}, {0, 1, 0});
    expectRay(panoramaRay(camera, 0.5, 0.75), kEye + Vec3{0.03, 0, 0}, {0, 1, 0});
    expectRay(panoramaRay(camera, 0.75, 0.25), kEye + Vec3{0, 0.03, 0}, {1, 0, 0});
    expectRay(panoramaRay(camera, 0, 0.75), kEye - Vec3{0.03, 0, 0}, {0, -1, 0});
    expectRay(panoramaRay(camera, 0.75, 0), kEye, {0, 0, 1});
    expectRay(panoramaRay(camera, 0.5, 0.5 - 1e-15), kEye, {0, 0, -1});
    // at a latitude of acos(1/4), half as far apart as on the horizon
    const double latitude = std::acos(0.25), row = 0.5 * (0.5 - latitude / std::acos(-1.0));
    EXPECT_NEAR(length(panoramaRay(camera, 0.4, row).origin - kEye), 0.015, 1e-12);
}

TEST(Panorama, IsLevelWhereverTheCameraLooks) {
    CameraRequest request;
    request.panorama = true;
    request.eye = kEye;
    request.target = kEye + Vec3{3, 0, -4};
    request.up = Vec3{0, 0, 2};
    const Camera down = frameCamera(request, {0, 0, 0}, {20, 20, 20}, 2);
    EXPECT_TRUE(down.panorama);
    EXPECT_LT(length(down.forward - Vec3{1, 0, 0}), 1e-12);
    EXPECT_LT(length(down.up - Vec3{0, 0, 1}), 1e-12);
    EXPECT_LT(length(down.right - Vec3{0, -1, 0}), 1e-12);
    request.target = kEye + Vec3{0, 0, -4};
    const Camera straight_down = frameCamera(request, {0, 0, 0}, {20, 20, 20}, 2);
    EXPECT_LT(length(straight_down.up - Vec3{0, 0, 1}), 1e-12);
    EXPECT_LT(std::abs(straight_down.forward.z), 1e-12);
    EXPECT_NEAR(length(straight_down.forward), 1, 1e-12);
}

TEST(Panorama, IsTwiceAsWideAsHighForEachEye) {
    EXPECT_EQ(panoramaSize(2048, false), (PixelSize{2048, 1024}));
    EXPECT_EQ(panoramaSize(2048, true), (PixelSize{2048, 2048}));
}

} // namespace
} // namespace pointrt
