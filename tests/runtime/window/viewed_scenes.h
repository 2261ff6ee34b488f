// SPDX-License-Identifier: Apache-2.0
// Scenes for tests of the window's camera, and views of them.
#pragma once

#include <gtest/gtest.h>

#include <limits>

#include "runtime/scene/camera.h"
#include "runtime/window/input/view_camera.h"

namespace pointrt {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr ViewSize kViewCameraSize{1280, 720};

struct ViewedScene {
    Vec3 low, high;
    double radius() const { return length(high - low) / 2; }
    Vec3 centre() const { return low + (high - low) * 0.5; }
};
inline const ViewedScene kUnit{{-1, -1, -1}, {1, 1, 1}};
inline const ViewedScene kNationalGrid{{2'600'000, 1'200'000, 400}, {2'600'030, 1'200'040, 520}}; // radius 65

/// A view from an oblique direction, so that no axis is special.
inline ViewCamera slantedView(const ViewedScene& scene, Vec3 up) {
    CameraRequest request;
    request.eye = scene.centre() + Vec3{1.7, 1.1, 2.3} * scene.radius();
    return framedView(request, scene.low, scene.high, up, 16.0 / 9);
}

inline void expectSame(const ViewCamera& a, const ViewCamera& b) {
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_EQ(a.pivot, b.pivot);
    EXPECT_EQ(a.up, b.up);
    EXPECT_EQ(a.fov_deg, b.fov_deg);
    EXPECT_EQ(a.ortho_height, b.ortho_height);
}

} // namespace pointrt
