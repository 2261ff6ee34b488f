// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/view_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "format/base/error.h"
#include "runtime/scene/camera.h"
#include "runtime/session/options.h"
#include "runtime/window/input/camera_text.h"
#include "runtime/window/input/view_flight.h"
#include "tests/runtime/window/viewed_scenes.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

constexpr double kNan = std::nan("");
const Vec3 kUps[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, -3, 0}, {1, 2, -3}};

void expectVectorsNear(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

double roll(const ViewCamera& view) { return dot(axesOf(view).right, normalize(view.up)); }

void expectSamePicture(const ViewCamera& a, const ViewCamera& b, double tolerance) {
    expectVectorsNear(axesOf(a).right, axesOf(b).right, tolerance);
    expectVectorsNear(axesOf(a).up, axesOf(b).up, tolerance);
    expectVectorsNear(a.eye, b.eye, tolerance * a.scene_radius);
}

TEST(ViewCamera, StartsAsFrameCameraFrames) {
    for (const ViewedScene& scene : {kUnit, kNationalGrid}) {
        const ViewCamera view = framedView({}, scene.low, scene.high, {0, 1, 0}, 1.5);
        const Camera framed = frameCamera({}, scene.low, scene.high, 1.5);
        EXPECT_EQ(view.eye, framed.eye);
        expectVectorsNear(view.pivot, scene.centre(), 0);
        expectVectorsNear(cameraOf(view).right, framed.right, 1e-15);
        expectVectorsNear(cameraOf(view).up, framed.up, 1e-15);
        expectVectorsNear(cameraOf(view).forward, framed.forward, 1e-15);
        EXPECT_EQ(cameraOf(view).fov_deg, framed.fov_deg);
    }
}

TEST(ViewCamera, RequestRoundTrips) {
    for (const Vec3& up : kUps)
        for (const ViewedScene& scene : {kUnit, kNationalGrid})
            for (ViewCamera view : {slantedView(scene, up), standardView(slantedView(scene, up), StandardView::kTop),
                                    oppositeView(standardView(slantedView(scene, up), StandardView::kTop)),
                                    orthoToggled(slantedView(scene, up))}) {
                const Camera camera = frameCamera(requestOf(view), scene.low, scene.high, 1);
                EXPECT_EQ(camera.eye, view.eye);
                expectVectorsNear(camera.right, cameraOf(view).right, 1e-12);
                expectVectorsNear(camera.up, cameraOf(view).up, 1e-12);
                EXPECT_EQ(camera.ortho_height, view.ortho_height);
            }
}

TEST(ViewCamera, PivotIsOnTheLineOfSight) {
    Camera camera = frameCamera({}, kUnit.low, kUnit.high, 1);
    const double distance = camera.eye.z;
    EXPECT_EQ(viewOf(camera, {0, 0, 0}, kUnit.low, kUnit.high, {0, 1, 0}).pivot, (Vec3{0, 0, 0}));
    expectVectorsNear(viewOf(camera, {3, 0, 1}, kUnit.low, kUnit.high, {0, 1, 0}).pivot, {0, 0, 1}, 1e-12);
    // the target is behind the eye: the pivot is a radius ahead
    const Vec3 behind{0, 0, distance + 1};
    expectVectorsNear(viewOf(camera, behind, kUnit.low, kUnit.high, {0, 1, 0}).pivot, {0, 0, distance - kUnit.radius()},
                      1e-12);
}

TEST(ViewCamera, KeepsTheRollOfATiltedCamera) {
    CameraRequest request;
    request.up = Vec3{1, 1, 0};
    const Camera tilted = frameCamera(request, kUnit.low, kUnit.high, 1);
    const ViewCamera view = viewOf(tilted, {}, kUnit.low, kUnit.high, {0, 1, 0});
    expectVectorsNear(cameraOf(view).right, tilted.right, 1e-12);
    expectVectorsNear(framedView(request, kUnit.low, kUnit.high, {0, 1, 0}, 1).up, {1, 1, 0}, 0);
}

TEST(ViewCamera, OrbitFollowsTheDrag) {
    for (const Vec3& up : kUps) {
        const ViewCamera view = slantedView(kUnit, up);
        const Vec3 near = view.pivot - axesOf(view).forward * 0.5; // towards the eye
        const ViewPoint before = *projected(view, kViewCameraSize, near);
        const ViewPoint right = *projected(orbited(view, kViewCameraSize, 10, 0), kViewCameraSize, near);
        const ViewPoint down = *projected(orbited(view, kViewCameraSize, 0, 10), kViewCameraSize, near);
        EXPECT_GT(right.x, before.x + 2);
        EXPECT_GT(down.y, before.y + 2);
        EXPECT_NEAR(down.x, before.x, 1e-9);
    }
}

TEST(ViewCamera, PictureHeightIsHalfATurn) {
    const ViewCamera view = framedView({}, kNationalGrid.low, kNationalGrid.high, {0, 1, 0}, 1);
    const ViewCamera behind = orbited(view, kViewCameraSize, kViewCameraSize.height, 0);
    expectVectorsNear(behind.eye - view.pivot, (view.eye - view.pivot) * -1, 1e-6);
    const ViewCamera quarter = orbited(view, kViewCameraSize, kViewCameraSize.height / 2, 0); // the camera moves left
    expectVectorsNear(normalize(quarter.eye - view.pivot), {-1, 0, 0}, 1e-8);
}

TEST(ViewCamera, OrbitKeepsHorizonAndDistance) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-300, 300);
    for (const Vec3& up : kUps)
        for (const ViewedScene& scene : {kUnit, kNationalGrid}) {
            ViewCamera view = slantedView(scene, up);
            const double distance = distanceToPivot(view);
            for (int i = 0; i < 5000; ++i) {
                view = orbited(view, kViewCameraSize, move(random), move(random));
                ASSERT_NEAR(roll(view), 0, 1e-9);
                ASSERT_GT(dot(axesOf(view).up, normalize(view.up)), 0); // never upside down
            }
            EXPECT_NEAR(distanceToPivot(view) / distance, 1, 1e-8);
            expectVectorsNear(view.pivot, scene.centre(), 0);
        }
}

TEST(ViewCamera, OrbitStopsBeforeThePoles) {
    for (const Vec3& up : kUps)
        for (double side : {1.0, -1.0}) {
            const ViewCamera view = orbited(slantedView(kNationalGrid, up), kViewCameraSize, 0, side * 5000);
            const double along = dot(axesOf(view).forward, normalize(up)) * -side;
            EXPECT_NEAR(std::acos(along) * 180 / std::numbers::pi, 0.1, 1e-6);
            EXPECT_NEAR(roll(view), 0, 1e-9);
            // and they return from there with the same right vector
            const ViewCamera back = orbited(view, kViewCameraSize, 0, side * -100);
            expectVectorsNear(axesOf(back).right, axesOf(view).right, 1e-6);
        }
}

TEST(ViewCamera, OrbitLeavesAPoleSmoothly) {
    for (const Vec3& up : kUps) {
        const ViewCamera top = standardView(slantedView(kNationalGrid, up), StandardView::kTop);
        for (const ViewCamera& pole : {top, oppositeView(top)}) {
            EXPECT_NEAR(std::abs(dot(axesOf(pole).forward, normalize(up))), 1, 1e-15);
            expectSamePicture(orbited(pole, kViewCameraSize, 0, 0), pole, 0.01); // 0.1 degrees from the pole
            expectSamePicture(orbited(pole, kViewCameraSize, 1, 0), pole, 0.03);
        }
    }
}

TEST(ViewCamera, PanFollowsTheCursor) {
    for (const Vec3& up : kUps)
        for (const ViewedScene& scene : {kUnit, kNationalGrid})
            for (const ViewCamera& view : {slantedView(scene, up), orthoToggled(slantedView(scene, up))}) {
                const Vec3 grabbed = pointAtPivotDepth(view, kViewCameraSize, 200, 610);
                const ViewCamera after = panned(view, kViewCameraSize, 333, -217);
                const ViewPoint there = *projected(after, kViewCameraSize, grabbed);
                EXPECT_NEAR(there.x, 533, 1e-5);
                EXPECT_NEAR(there.y, 393, 1e-5);
                expectVectorsNear(axesOf(after).forward, axesOf(view).forward, 1e-8);
            }
}

TEST(ViewCamera, ZoomIsAboutTheCursor) {
    for (const ViewedScene& scene : {kUnit, kNationalGrid})
        for (ViewCamera view : {slantedView(scene, {0, 0, 1}), orthoToggled(slantedView(scene, {0, 0, 1}))}) {
            const Vec3 aimed = pointAtPivotDepth(view, kViewCameraSize, 1000, 100);
            const double height = heightAtPivot(view);
            for (double steps : {1.0, 2.5, 0.5}) view = zoomed(view, kViewCameraSize, steps, 1000, 100);
            EXPECT_NEAR(heightAtPivot(view) / height, 0.5, 1e-8);
            EXPECT_NEAR(projected(view, kViewCameraSize, aimed)->x, 1000, 1e-4);
            EXPECT_NEAR(projected(view, kViewCameraSize, aimed)->y, 100, 1e-4);
        }
}

TEST(ViewCamera, ZoomRespectsItsLimits) {
    for (const ViewedScene& scene : {kUnit, kNationalGrid})
        for (ViewCamera view : {slantedView(scene, {0, 1, 0}), orthoToggled(slantedView(scene, {0, 1, 0}))}) {
            const Vec3 forward = axesOf(view).forward;
            const double to_distance = 1 / (2 * std::tan(20 * std::numbers::pi / 180));
            for (int i = 0; i < 300; ++i) view = zoomed(view, kViewCameraSize, 1, 640, 360);
            expectVectorsNear(axesOf(view).forward, forward, 1e-6);
            EXPECT_NEAR(heightAtPivot(view) * to_distance / scene.radius(), 1e-4, 1e-7);
            for (int i = 0; i < 300; ++i) view = zoomed(view, kViewCameraSize, -1, 640, 360);
            EXPECT_NEAR(heightAtPivot(view) * to_distance / scene.radius(), 1e3, 1e-3);
            EXPECT_NO_THROW(frameCamera(requestOf(view), scene.low, scene.high, 1));
        }
}

TEST(ViewCamera, ZoomReturnsFromBeyondItsLimits) {
    CameraRequest request;
    request.eye = Vec3{0, 0, 9000};
    const ViewCamera far = framedView(request, kUnit.low, kUnit.high, {0, 1, 0}, 1);
    expectSame(zoomed(far, kViewCameraSize, -1, 640, 360), far);
    EXPECT_NEAR(zoomed(far, kViewCameraSize, 4, 640, 360).eye.z, 4500, 1e-6);
}

TEST(ViewCamera, CentringKeepsSizes) {
    for (const Vec3& up : kUps) {
        const ViewCamera view = slantedView(kNationalGrid, up);
        const Vec3 point = view.pivot + Vec3{20, -9, 13}, beside = point + axesOf(view).right;
        const ViewCamera after = centredOn(view, point);
        EXPECT_EQ(after.pivot, point);
        expectVectorsNear(axesOf(after).forward, axesOf(view).forward, 1e-9);
        EXPECT_NEAR(projected(after, kViewCameraSize, point)->x, 640, 1e-4);
        EXPECT_NEAR(projected(after, kViewCameraSize, point)->y, 360, 1e-4);
        const auto width = [&](const ViewCamera& v) {
            return projected(v, kViewCameraSize, beside)->x - projected(v, kViewCameraSize, point)->x;
        };
        EXPECT_NEAR(width(after), width(view), 1e-5);
    }
}

TEST(ViewCamera, CentringBehindTheEyeKeepsTheDistance) {
    const ViewCamera view = slantedView(kUnit, {0, 1, 0});
    const ViewCamera after = centredOn(view, view.eye - axesOf(view).forward);
    EXPECT_NEAR(distanceToPivot(after), distanceToPivot(view), 1e-12);
    const ViewCamera ortho = orthoToggled(view);
    EXPECT_EQ(centredOn(ortho, {0.5, 0.5, 0.5}).ortho_height, ortho.ortho_height);
}

TEST(ViewCamera, FlyingSpeedFollowsThePivotDistance) {
    const ViewCamera far = slantedView(kNationalGrid, {0, 0, 1});
    ViewCamera near = far;
    near.pivot = far.eye + axesOf(far).forward * 2.0; // 2 m, in a scene of radius 65
    expectVectorsNear(flown(near, {0, 0, 1}, 0.5).eye, near.eye + axesOf(near).forward * 1.0, 1e-7);
    expectVectorsNear(flown(near, {1, 0, 0}, 0.5).eye, near.eye + axesOf(near).right * 1.0, 1e-7);
}

TEST(ViewCamera, FlyingSpeedIsLimitedBySceneSize) {
    for (const Vec3& up : kUps) {
        const ViewCamera view = slantedView(kNationalGrid, up);
        const double step = 65 * 0.5 * 0.1;
        const ViewAxes axes = axesOf(view);
        expectVectorsNear(flown(view, {0, 0, 1}, 0.1).eye, view.eye + axes.forward * step, 1e-7);
        expectVectorsNear(flown(view, {-1, 0, 0}, 0.1).eye, view.eye - axes.right * step, 1e-7);
        expectVectorsNear(flown(view, {0, 1, 0}, 0.1).eye, view.eye + normalize(up) * step, 1e-7);
        EXPECT_NEAR(distanceToPivot(flown(view, {1, -1, 1}, 3)), distanceToPivot(view), 1e-7);
    }
    const ViewCamera ortho = orthoToggled(slantedView(kUnit, {0, 1, 0}));
    EXPECT_NEAR(flown(ortho, {0, 0, 1}, 1).ortho_height, ortho.ortho_height / 2, 1e-12);
    EXPECT_EQ(flown(ortho, {1, 0, 0}, 1).ortho_height, ortho.ortho_height);
}

TEST(ViewCamera, LookRotatesAboutTheEye) {
    for (const Vec3& up : kUps) {
        const ViewCamera view = slantedView(kNationalGrid, up);
        const ViewCamera right = looked(view, kViewCameraSize, 100, 0),
                         up_there = looked(view, kViewCameraSize, 0, -100);
        EXPECT_EQ(right.eye, view.eye);
        EXPECT_GT(dot(axesOf(right).forward, axesOf(view).right), 0.1);
        EXPECT_GT(dot(axesOf(up_there).forward, axesOf(view).up), 0.1);
        EXPECT_NEAR(roll(up_there), 0, 1e-9);
        EXPECT_NEAR(dot(axesOf(looked(view, kViewCameraSize, 0, -1e5)).forward, normalize(up)), 1, 1e-5);
        EXPECT_NEAR(distanceToPivot(right), distanceToPivot(view), 1e-6);
    }
    const double angle = std::acos(dot(axesOf(looked(slantedView(kUnit, {0, 1, 0}), kViewCameraSize, 0, 72)).forward,
                                       axesOf(slantedView(kUnit, {0, 1, 0})).forward));
    EXPECT_NEAR(angle * 180 / std::numbers::pi, 9, 1e-9); // a tenth of a quarter turn
}

struct StandardCase {
    Vec3 up, front, right, top_up; // direction to the eye; up direction of the top view
};

TEST(ViewCamera, StandardViewsUseTheUpAxis) {
    const StandardCase cases[] = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}},
                                  {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}},
                                  {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}},
                                  {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}}};
    for (const StandardCase& each : cases)
        for (const ViewedScene& scene : {kUnit, kNationalGrid}) {
            const ViewCamera view = slantedView(scene, each.up);
            const auto from = [&](const ViewCamera& v) { return normalize(v.eye - v.pivot); };
            const ViewCamera front = standardView(view, StandardView::kFront);
            const ViewCamera right = standardView(view, StandardView::kRight);
            const ViewCamera top = standardView(view, StandardView::kTop);
            expectVectorsNear(from(front), each.front, 1e-9);
            expectVectorsNear(axesOf(front).up, each.up, 1e-9);
            expectVectorsNear(from(right), each.right, 1e-9);
            expectVectorsNear(from(top), each.up, 1e-9);
            expectVectorsNear(axesOf(top).up, each.top_up, 1e-9);
            expectVectorsNear(from(oppositeView(front)), each.front * -1, 1e-9);
            expectVectorsNear(from(oppositeView(top)), each.up * -1, 1e-9);
            expectVectorsNear(axesOf(oppositeView(top)).up, each.top_up, 1e-9);
            expectSamePicture(oppositeView(oppositeView(view)), view, 1e-9);
            EXPECT_EQ(top.pivot, view.pivot);
        }
}

TEST(ViewCamera, TopViewMatchesFrameCamera) {
    for (const Vec3& up : kUps) {
        const ViewCamera top = standardView(slantedView(kUnit, up), StandardView::kTop);
        CameraRequest request;
        request.eye = top.eye;
        request.target = top.pivot;
        request.up = top.up;
        expectVectorsNear(frameCamera(request, kUnit.low, kUnit.high, 1).up, axesOf(top).up, 1e-9);
    }
}

TEST(ViewCamera, OrthographicKeepsTheSizeAtThePivot) {
    for (const ViewedScene& scene : {kUnit, kNationalGrid}) {
        ViewCamera view = zoomed(slantedView(scene, {0, 1, 0}), kViewCameraSize, 12, 800, 300);
        const ViewCamera ortho = orthoToggled(view);
        EXPECT_EQ(ortho.ortho_height, heightAtPivot(view));
        const Vec3 beside = pointAtPivotDepth(view, kViewCameraSize, 111, 222);
        EXPECT_NEAR(projected(ortho, kViewCameraSize, beside)->x, 111, 1e-4);
        EXPECT_NEAR(projected(ortho, kViewCameraSize, beside)->y, 222, 1e-4);
        expectVectorsNear(orthoToggled(ortho).eye, view.eye, 1e-7 * scene.radius());
        ViewCamera turning = ortho;
        for (int i = 0; i < 50; ++i) {
            turning = panned(orbited(zoomed(turning, kViewCameraSize, 0.3, 900, 500), kViewCameraSize, 77, 13),
                             kViewCameraSize, 50, -20);
            const double depth = dot(scene.centre() - turning.eye, axesOf(turning).forward);
            EXPECT_GE(depth, scene.radius() * (1 - 1e-6));
        }
    }
}

TEST(ViewCamera, FovCanKeepTheSizeAtThePivot) {
    const ViewCamera view = slantedView(kUnit, {0, 1, 0});
    EXPECT_NEAR(heightAtPivot(withFov(view, 15, true)), heightAtPivot(view), 1e-12);
    EXPECT_EQ(withFov(view, 15, false).eye, view.eye);
    EXPECT_EQ(withFov(view, 15, false).fov_deg, 15);
    EXPECT_EQ(withFov(view, 0, false).fov_deg, 1);
    EXPECT_EQ(withFov(view, 500, false).fov_deg, 170);
}

TEST(ViewCamera, PointsBehindTheEyeAreNotProjected) {
    const ViewCamera view = slantedView(kUnit, {0, 1, 0});
    EXPECT_FALSE(projected(view, kViewCameraSize, view.eye - axesOf(view).forward));
    EXPECT_NEAR(projected(view, kViewCameraSize, view.pivot)->depth, distanceToPivot(view), 1e-12);
}

TEST(ViewCamera, NonFiniteNumbersChangeNothing) {
    for (const ViewCamera& view : {slantedView(kNationalGrid, {0, 0, 1}), orthoToggled(slantedView(kUnit, {0, 1, 0}))})
        for (double bad : {kNan, kInfinity, -kInfinity}) {
            expectSame(orbited(view, kViewCameraSize, bad, 0), view);
            expectSame(panned(view, kViewCameraSize, 0, bad), view);
            expectSame(zoomed(view, kViewCameraSize, bad, 1, 1), view);
            expectSame(zoomed(view, kViewCameraSize, 1, bad, 1), view);
            expectSame(flown(view, {0, 0, bad}, 1), view);
            expectSame(flown(view, {1, 0, 0}, bad), view);
            expectSame(looked(view, kViewCameraSize, bad, 1), view);
            expectSame(centredOn(view, {bad, 0, 0}), view);
            expectSame(withFov(view, bad, true), view);
        }
}

TEST(ViewCamera, StaysWithinFrameCamerasLimits) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> move(-1, 1);
    for (const ViewedScene& scene : {kUnit, kNationalGrid, ViewedScene{{1e6, 1e6, 1e6}, {1e6 + 1e-3, 1e6, 1e6}}}) {
        ViewCamera view = slantedView(scene, {0, 0, 1});
        for (int i = 0; i < 20000; ++i) {
            const double a = move(random) * 1000, b = move(random) * 1000;
            switch (random() % 9) {
            case 0:
                view = orbited(view, kViewCameraSize, a, b);
                break;
            case 1:
                view = panned(view, kViewCameraSize, a * 3, b * 3);
                break;
            case 2:
                view = zoomed(view, kViewCameraSize, a / 50, 640 + a, 360 + b);
                break;
            case 3:
                view = flown(view, {move(random), move(random), move(random)}, 200);
                break;
            case 4:
                view = looked(view, kViewCameraSize, a, b);
                break;
            case 5:
                view = standardView(view, static_cast<StandardView>(random() % 3));
                break;
            case 6:
                view = oppositeView(view);
                break;
            case 7:
                view = orthoToggled(view);
                break;
            case 8:
                view = centredOn(view, pointAtPivotDepth(view, kViewCameraSize, 640 + a, 360 + b));
                break;
            }
            ASSERT_NO_THROW(frameCamera(requestOf(view), scene.low, scene.high, 1)) << i;
            ASSERT_NEAR(roll(view), 0, 1e-4) << i;
            ASSERT_NEAR(length(axesOf(view).right), 1, 1e-9) << i;
        }
    }
}

TEST(ViewFlight, StartsAndEndsAtItsViews) {
    const ViewCamera from = slantedView(kNationalGrid, {0, 0, 1});
    const ViewCamera to =
        zoomed(orbited(centredOn(from, kNationalGrid.low), kViewCameraSize, 200, 100), kViewCameraSize, 3, 0, 0);
    const ViewFlight flight{from, to, 10};
    expectSamePicture(viewAt(flight, 10), from, 1e-9);
    expectSamePicture(viewAt(flight, 9), from, 1e-9);
    expectSame(viewAt(flight, 10.31), to);
    expectSamePicture(viewAt(flight, 10.2999999), to, 1e-6);
    EXPECT_FALSE(isFinished(flight, 10.29));
    EXPECT_TRUE(isFinished(flight, 10.31));
    EXPECT_TRUE(isFinished(flight, kNan)); // an invalid time ends it
}

TEST(ViewFlight, IsLevelAndEased) {
    for (const Vec3& up : kUps) {
        const ViewCamera from = standardView(slantedView(kUnit, up), StandardView::kTop);
        const ViewFlight flight{from, orbited(from, kViewCameraSize, 500, -500), 0};
        double last = 0;
        for (int i = 0; i <= 30; ++i) {
            const ViewCamera view = viewAt(flight, i * 0.01);
            EXPECT_NEAR(roll(view), 0, 1e-9);
            const double translated = length(view.eye - from.eye);
            EXPECT_GE(translated, last - 1e-9);
            last = translated;
        }
        const auto step = [&](double time_s) {
            return length(viewAt(flight, time_s + 0.01).eye - viewAt(flight, time_s).eye);
        };
        EXPECT_LT(step(0) * 4, step(0.145));
        EXPECT_LT(step(0.29) * 4, step(0.145));
    }
}

TEST(ViewFlight, TakesTheShortWay) {
    const ViewCamera from = slantedView(kUnit, {0, 1, 0});
    const ViewCamera to = orbited(from, kViewCameraSize, 1400, 0); // 350 degrees one way, 10 the other
    const ViewCamera half = viewAt({from, to, 0}, 0.15);
    EXPECT_NEAR(std::acos(dot(axesOf(half).right, axesOf(from).right)) * 180 / std::numbers::pi, 5, 1e-6);
}

TEST(ViewFlight, ProjectionChangeKeepsTheSize) {
    const ViewCamera from = slantedView(kUnit, {0, 1, 0});
    const ViewCamera to = zoomed(orthoToggled(from), kViewCameraSize, 4, 640, 360);
    for (const ViewFlight& flight : {ViewFlight{from, to, 0}, ViewFlight{to, from, 0}}) {
        EXPECT_NEAR(heightAtPivot(viewAt(flight, 0)) / heightAtPivot(flight.from), 1, 1e-9);
        const double half = std::sqrt(heightAtPivot(from) * heightAtPivot(to));
        EXPECT_NEAR(heightAtPivot(viewAt(flight, 0.15)) / half, 1, 1e-9);
    }
}

std::string errorOf(const std::string& text) {
    try {
        withCameraText(slantedView(kUnit, {0, 1, 0}), text);
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        return error.what();
    }
}

TEST(CameraText, UsesCommandLineOptions) {
    CameraRequest request;
    request.eye = Vec3{0.1, -2, 1e-7};
    request.target = Vec3{1, 0, 0};
    const ViewCamera view = framedView(request, kUnit.low, kUnit.high, {0, 1, 0}, 1);
    EXPECT_EQ(cameraText(view), "--eye 0.1,-2,1e-07 --target 1,0,0 --up 0,1,0 --fov 40");
    ViewCamera ortho = view;
    ortho.ortho_height = 2.5;
    EXPECT_EQ(cameraText(ortho), "--eye 0.1,-2,1e-07 --target 1,0,0 --up 0,1,0 --ortho 2.5");
}

TEST(CameraText, CommandLineAcceptsIt) {
    for (const ViewCamera& view : {slantedView(kNationalGrid, {0, 0, 1}),
                                   orthoToggled(standardView(slantedView(kUnit, {0, 1, 0}), StandardView::kTop))}) {
        std::istringstream text("pointrt-view a.pro -o a.png " + cameraText(view));
        const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
        std::vector<const char*> arguments;
        for (const std::string& word : words) arguments.push_back(word.c_str());
        Options options;
        ASSERT_FALSE(parseOptions(static_cast<int>(arguments.size()), arguments.data(), options));
        options.camera.fov_deg = options.fov_deg.value_or(view.fov_deg);
        EXPECT_EQ(options.camera, requestOf(view));
    }
}

TEST(CameraText, RoundTripsExactly) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> move(-400, 400);
    for (const Vec3& up : kUps)
        for (const ViewedScene& scene : {kUnit, kNationalGrid}) {
            const ViewCamera other = slantedView(scene, {0, 1, 0});
            ViewCamera view = slantedView(scene, up);
            for (int i = 0; i < 200; ++i) {
                view = panned(orbited(view, kViewCameraSize, move(random), move(random)), kViewCameraSize, move(random),
                              move(random));
                view = zoomed(view, kViewCameraSize, move(random) / 100, 640 + move(random), 360);
                if (i % 7 == 0) view = orthoToggled(view);
                const ViewCamera pasted = withCameraText(other, cameraText(view));
                EXPECT_EQ(pasted.eye, view.eye);
                EXPECT_EQ(pasted.pivot, view.pivot);
                EXPECT_EQ(pasted.up, view.up);
                EXPECT_EQ(pasted.ortho_height, view.ortho_height);
                EXPECT_EQ(cameraText(pasted), cameraText(view));
                expectSamePicture(pasted, view, 1e-12);
            }
        }
}

TEST(CameraText, TopViewKeepsItsAxis) {
    for (const Vec3& up : kUps) {
        const ViewCamera view = slantedView(kNationalGrid, up);
        const ViewCamera top = standardView(view, StandardView::kTop);
        const ViewCamera pasted = withCameraText(view, cameraText(top));
        EXPECT_EQ(pasted.up, view.up);
        expectSamePicture(pasted, top, 1e-12);
        EXPECT_EQ(cameraText(pasted), cameraText(top));
    }
    // the axis itself as --up, as frameCamera makes it
    const std::string text = "--eye 0,9,0 --target 0,0,0 --up 0,1,0";
    expectVectorsNear(axesOf(withCameraText(slantedView(kUnit, {0, 1, 0}), text)).up, {0, 0, -1}, 1e-12);
}

TEST(CameraText, AcceptsAnyOrderAndMissingOptions) {
    const ViewCamera view = slantedView(kUnit, {0, 0, 1});
    const ViewCamera pasted = withCameraText(view, " \n--target 1, 2 ,3\r\n\t--eye\n4,5,\n6  ");
    EXPECT_EQ(pasted.eye, (Vec3{4, 5, 6}));
    EXPECT_EQ(pasted.pivot, (Vec3{1, 2, 3}));
    EXPECT_EQ(pasted.up, view.up);
    EXPECT_EQ(pasted.fov_deg, view.fov_deg);
    const ViewCamera ortho = orthoToggled(view);
    EXPECT_EQ(withCameraText(ortho, "--eye 4,5,6 --target 1,2,3").ortho_height, ortho.ortho_height);
    EXPECT_EQ(withCameraText(ortho, "--eye 4,5,6 --target 1,2,3 --fov 30").ortho_height, 0);
    EXPECT_EQ(withCameraText(view, "--eye 4,5,6 --target 1,2,3 --ortho 3").ortho_height, 3);
}

TEST(CameraText, RejectsOtherTextWithAReason) {
    const std::string good = "--eye 4,5,6 --target 1,2,3 ";
    EXPECT_EQ(errorOf(good), "");
    EXPECT_SAYS(errorOf(""), "camera text: --eye *missing");
    EXPECT_SAYS(errorOf("--eye 1,2,3"), "camera text: --target *missing");
    EXPECT_SAYS(errorOf("hello world"), "camera text: \"hello\" *--eye, --target, --up, --fov, --ortho");
    EXPECT_SAYS(errorOf(good + "--eye 1,2,3"), "camera text: --eye *twice");
    EXPECT_SAYS(errorOf(good + "--up"), "camera text: --up *no value");
    EXPECT_SAYS(errorOf(good + "--up 1,2"), "camera text: --up: *\"1,2\"");
    EXPECT_SAYS(errorOf(good + "--up 1,2,inf"), "camera text: --up: *\"1,2,inf\"");
    EXPECT_SAYS(errorOf(good + "--fov 180"), "camera text: --fov: *\"180\"");
    EXPECT_SAYS(errorOf(good + "--ortho -1"), "camera text: --ortho: *\"-1\"");
    EXPECT_SAYS(errorOf(good + "--fov 20 --ortho 2"), "camera text: --fov *--ortho *combined");
    EXPECT_SAYS(errorOf(std::string(5000, ' ')), "camera text: *long");
    for (const char* text : {"--up 0,0,0", "--ortho 1e11", "--fov 0.0001"}) EXPECT_NE(errorOf(good + text), "");
    EXPECT_NE(errorOf("--eye 1,1,1 --target 1,1,1"), "");
    EXPECT_NE(errorOf("--eye 1e300,1,1 --target 1,1,1"), "");
    EXPECT_EQ(errorOf("\x1b[31m\xff --x").find('\x1b'), std::string::npos);
}

TEST(CameraText, AcceptsUpOfAnyLength) {
    for (const char* up : {"0,1e-300,0", "0,1e300,0", "0,5e-324,0"}) {
        const std::string text = std::string("--eye 4,5,6 --target 1,2,3 --up ") + up;
        const ViewCamera pasted = withCameraText(slantedView(kUnit, {0, 1, 0}), text);
        EXPECT_NEAR(roll(pasted), 0, 1e-12);
        EXPECT_NEAR(length(axesOf(pasted).right), 1, 1e-12);
    }
}

} // namespace
} // namespace pointrt
