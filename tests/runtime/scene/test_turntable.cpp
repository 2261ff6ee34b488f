// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/turntable.h"

#include <gtest/gtest.h>

#include "format/base/error.h"
#include "runtime/scene/camera.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

void expectNear(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12); }

std::string refusal(const std::string& path, bool turntable) {
    try {
        requireFrameNames(path, turntable ? "--turntable" : nullptr);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
        return error.what();
    }
    return "";
}

TEST(Turntable, RotatesCounterclockwiseAboutTheAxis) {
    CameraRequest request;
    request.eye = Vec3{2, 5, 1};
    request.target = Vec3{2, 1, -3};
    const Camera camera = frameCamera(request, {}, {1, 1, 1}, 1);
    const Camera quarter = turntableCamera(camera, {*request.target, {0, 1, 0}}, 1, 4);
    expectNear(quarter.eye, {6, 5, -3}); // rotating from +Z towards +X, as seen from +Y
    expectNear(quarter.forward, normalize(*request.target - quarter.eye));
    expectNear(quarter.right, {0, 0, -1});
    expectNear(cross(quarter.right, quarter.forward), quarter.up);
    EXPECT_EQ(quarter.fov_deg, camera.fov_deg);
}

TEST(Turntable, StartsWithTheCameraAndReturnsToIt) {
    const Camera camera = frameCamera({}, {0, 0, 0}, {1, 2, 3}, 1);
    const TurntableAxis axis{{0.5, 1, 1.5}, normalize(Vec3{1, 2, 3})};
    const Camera first = turntableCamera(camera, axis, 0, 7);
    EXPECT_EQ(first.eye, camera.eye);
    EXPECT_EQ(first.right, camera.right);
    Camera walked = camera;
    for (int step = 0; step < 7; ++step) walked = turntableCamera(walked, axis, 1, 7);
    expectNear(walked.eye, camera.eye);
    expectNear(walked.up, camera.up);
}

TEST(Turntable, NumbersItsFiles) {
    EXPECT_EQ(frameName("a/%d.png", 12), "a/12.png");
    EXPECT_EQ(frameName("%04d.exr", 12), "0012.exr");
    EXPECT_EQ(frameName("%02d.exr", 1234), "1234.exr");
}

TEST(Turntable, RefusesOtherPatterns) {
    for (const char* good : {"a/%d.png", "%01d.png", "%09d.exr"}) EXPECT_EQ(refusal(good, true), "") << good;
    for (const char* bad : {"a.png", "%.png", "%4d.png", "%00d.png", "%0d.png", "%012d.png", "%s.png", "%d%d.png",
                            "%%%d.png", "50%/%04d.png", "%x%d.png"})
        EXPECT_NE(refusal(bad, true), "") << bad;
    for (const char* plain : {"a.png", "50%.png", "%s.png", ""}) EXPECT_EQ(refusal(plain, false), "") << plain;
    EXPECT_SAYS(refusal("a%04d.png", false), "a%04d.png: \"%04d\" *--turntable");
}

} // namespace
} // namespace pointrt
