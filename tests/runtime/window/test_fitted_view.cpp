// SPDX-License-Identifier: Apache-2.0
// Views from the sides and the top, moved to show the whole scene.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/runtime/window/viewed_scenes.h"

namespace pointrt {
namespace {

/// Where the corners of the scene's bounds are in the picture.
struct PictureBox {
    double left = kInfinity, right = -kInfinity, top = kInfinity, bottom = -kInfinity;
};

PictureBox boxInPicture(const ViewCamera& view, const ViewedScene& scene) {
    PictureBox box;
    for (unsigned bits = 0; bits < 8; ++bits) {
        const Vec3 corner{bits & 1 ? scene.high.x : scene.low.x, bits & 2 ? scene.high.y : scene.low.y,
                          bits & 4 ? scene.high.z : scene.low.z};
        const ViewPoint at = projected(view, kViewCameraSize, corner).value();
        box = {std::min(box.left, at.x), std::max(box.right, at.x), std::min(box.top, at.y),
               std::max(box.bottom, at.y)};
    }
    return box;
}

TEST(ViewCamera, StandardViewsFitTheScene) {
    const ViewedScene site{{0, 0, 0}, {1100, 1200, 180}}; // flat and nearly square, as a stadium's surroundings
    constexpr double kOffset = 0.2, kFree = 1280 - 2 * kOffset * 720; // beside a panel
    for (const ViewedScene& scene : {kUnit, kNationalGrid, site})
        for (const StandardView which : {StandardView::kTop, StandardView::kFront, StandardView::kLeft})
            for (const bool is_ortho : {false, true}) {
                ViewCamera view = slantedView(scene, {0, 0, 1});
                if (is_ortho) view = orthoToggled(view);
                view = fittedView(standardView(withPivotOffset(view, kOffset), which), kViewCameraSize);
                const PictureBox box = boxInPicture(view, scene);
                EXPECT_GT(box.left, 0);
                EXPECT_LT(box.right, kFree);
                EXPECT_GT(box.top, 0);
                EXPECT_LT(box.bottom, 720);
                const double filled = std::max((box.right - box.left) / kFree, (box.bottom - box.top) / 720);
                EXPECT_NEAR(filled, 1 / 1.1, is_ortho ? 1e-6 : 0.13) << "a box's nearer side decides";
            }
}

TEST(ViewCamera, StandardViewsKeepADetail) {
    const ViewCamera near = zoomed(slantedView(kUnit, {0, 1, 0}), kViewCameraSize, 12, 640, 360);
    expectSame(fittedView(near, kViewCameraSize), near);
    const ViewCamera aside = centredOn(slantedView(kUnit, {0, 1, 0}), {1, 1, 1});
    expectSame(fittedView(aside, kViewCameraSize), aside);
}

} // namespace
} // namespace pointrt
