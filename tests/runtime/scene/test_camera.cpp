// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "format/base/error.h"

namespace pointrt {
namespace {

// A scan in a national grid: 30 by 40 by 120 around the centre, so that the half diagonal is 65.
const Vec3 kMin{500'000, 4'500'000, 100}, kMax{500'030, 4'500'040, 220};
const Vec3 kCentre{500'015, 4'500'020, 160};
constexpr double kRadius = 65;

void expectNear(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

void expectOrthonormal(const Camera& camera) {
    for (Vec3 axis : {camera.right, camera.up, camera.forward}) EXPECT_NEAR(length(axis), 1, 1e-12);
    expectNear(cross(camera.right, camera.up), camera.forward * -1, 1e-12);
}

/// The smallest signed distance of the sphere from the four sides of the view; 0 if it touches one from inside.
double margin(const Camera& camera, double aspect, Vec3 centre, double radius) {
    const double tan_v = std::tan(camera.fov_deg / 2 * std::numbers::pi / 180), tan_h = tan_v * aspect;
    const Vec3 to = centre - camera.eye;
    const double z = dot(to, camera.forward), x = std::abs(dot(to, camera.right)), y = std::abs(dot(to, camera.up));
    const double side = (z * tan_h - x) / std::hypot(1, tan_h), top = (z * tan_v - y) / std::hypot(1, tan_v);
    return std::min(side, top) - radius;
}

ExitCode errorOf(const CameraRequest& request) {
    try {
        frameCamera(request, kMin, kMax, 1);
        return ExitCode::kDone;
    } catch (const Error& error) {
        return error.code;
    }
}

TEST(Camera, FramesTheWholeSphereFromPlusZ) {
    const Camera camera = frameCamera({}, kMin, kMax, 1);
    EXPECT_EQ(camera.fov_deg, 40);
    expectNear(camera.eye, kCentre + Vec3{0, 0, kRadius / std::sin(20 * std::numbers::pi / 180)}, 1e-6);
    expectNear(camera.forward, {0, 0, -1}, 1e-12);
    expectNear(camera.up, {0, 1, 0}, 1e-12);
    expectNear(camera.right, {1, 0, 0}, 1e-12);
}

TEST(Camera, TouchesTheNarrowerSideAtEveryAspect) {
    for (double fov : {1.0, 40.0, 90.0, 170.0})
        for (double aspect : {0.1, 0.5, 1.0, 16.0 / 9, 10.0}) {
            CameraRequest request;
            request.fov_deg = fov;
            const Camera camera = frameCamera(request, kMin, kMax, aspect);
            EXPECT_NEAR(margin(camera, aspect, kCentre, kRadius), 0, 1e-6) << fov << " " << aspect;
        }
}

TEST(Camera, LooksAtTheCentreFromAGivenEye) {
    CameraRequest request;
    request.eye = kCentre + Vec3{300, 0, 0};
    const Camera camera = frameCamera(request, kMin, kMax, 1);
    expectNear(camera.eye, *request.eye, 0);
    expectNear(camera.forward, {-1, 0, 0}, 1e-9);
    expectNear(camera.right, {0, 0, -1}, 1e-9);
    expectOrthonormal(camera);
}

TEST(Camera, KeepsDirectionAndDistanceToAGivenTarget) {
    const Camera whole = frameCamera({}, kMin, kMax, 1.5);
    CameraRequest request;
    request.target = kMin;
    const Camera camera = frameCamera(request, kMin, kMax, 1.5);
    expectNear(camera.eye - kMin, whole.eye - kCentre, 1e-6);
    expectNear(camera.forward, whole.forward, 1e-12);
}

TEST(Camera, ReplacesAnUpAlongTheView) {
    CameraRequest request;
    request.eye = kCentre + Vec3{0, 10, 0};
    const Camera above = frameCamera(request, kMin, kMax, 1);
    expectNear(above.up, {0, 0, -1}, 1e-9);
    expectOrthonormal(above);
    request.eye = kCentre + Vec3{0, 0, -10};
    request.up = Vec3{0, 0, -5};
    const Camera behind = frameCamera(request, kMin, kMax, 1);
    expectNear(behind.up, {0, 1, 0}, 1e-9);
    expectOrthonormal(behind);
}

TEST(Camera, TakesAnUnnormalisedSlantedUp) {
    CameraRequest request;
    request.up = Vec3{7, 0, 7};
    expectNear(frameCamera(request, kMin, kMax, 1).up, {1, 0, 0}, 1e-9);
}

TEST(Camera, SurvivesDegenerateScenes) {
    expectOrthonormal(frameCamera({}, kMin, kMin, 1)); // one splat
    CameraRequest request;
    request.eye = kCentre; // the eye is at the target
    expectNear(frameCamera(request, kMin, kMax, 1).forward, {0, 0, -1}, 1e-9);
}

TEST(Camera, FitsTheSphereIntoAParallelPicture) {
    for (double aspect : {0.1, 0.5, 1.0, 16.0 / 9, 10.0})
        for (double fov : {1.0, 40.0, 179.0}) {
            CameraRequest request;
            request.ortho = true;
            request.fov_deg = fov;
            const Camera camera = frameCamera(request, kMin, kMax, aspect);
            EXPECT_NEAR(std::min(camera.ortho_height, camera.ortho_height * aspect), 2 * kRadius, 1e-6);
            EXPECT_EQ(camera.ortho_height, framingHeight(kMin, kMax, aspect));
            expectNear(camera.eye + dot(kCentre - camera.eye, camera.forward) * camera.forward, kCentre, 1e-6);
        }
}

TEST(Camera, TakesAHeightAndAnEyeAsTheyAre) {
    CameraRequest request;
    request.eye = kCentre + Vec3{10, 0, 0}; // within the sphere
    request.ortho_height = 12.5;
    const Camera camera = frameCamera(request, kMin, kMax, 1);
    EXPECT_EQ(camera.ortho_height, 12.5);
    expectNear(camera.eye, *request.eye, 0);
    EXPECT_EQ(frameCamera({}, kMin, kMax, 1).ortho_height, 0) << "a pinhole by default";
}

TEST(Camera, LeavesNothingBehindAParallelPicture) {
    for (const Vec3 target : {kCentre, kMin, kMax, kCentre - Vec3{0, 0, 1000}, kCentre + Vec3{3, 0, 1000}}) {
        CameraRequest request;
        request.target = target;
        request.ortho = true;
        request.fov_deg = 170;
        const Camera camera = frameCamera(request, kMin, kMax, 1);
        EXPECT_GE(dot(kCentre - camera.eye, camera.forward), kRadius);
        expectNear(normalize(target - camera.eye), camera.forward, 1e-9);
    }
}

TEST(Camera, RefusesHeightsThatShowNothing) {
    for (const double height :
         {0.0, -1.0, 1e-6 * kRadius, 1.1e4 * kRadius, std::numeric_limits<double>::infinity(), std::nan("")}) {
        CameraRequest request;
        request.ortho_height = height;
        EXPECT_EQ(errorOf(request), ExitCode::kBadUsage) << height;
    }
}

TEST(Camera, RefusesInvalidRequests) {
    CameraRequest same, no_up, flat, full;
    same.eye = same.target = kCentre;
    no_up.up = Vec3{0, 0, 0};
    flat.fov_deg = 0;
    full.fov_deg = 180;
    for (const CameraRequest& request : {same, no_up, flat, full}) EXPECT_EQ(errorOf(request), ExitCode::kBadUsage);
}

} // namespace
} // namespace pointrt
