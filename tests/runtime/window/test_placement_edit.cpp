// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/placement_edit.h"

#include <gtest/gtest.h>

#include "runtime/device_scene/render_space.h"

namespace pointrt {
namespace {

constexpr Vec3 kPivot{3, -2, 5};

void expectAt(Vec3 a, Vec3 b, double error = 1e-12) {
    EXPECT_NEAR(a.x, b.x, error);
    EXPECT_NEAR(a.y, b.y, error);
    EXPECT_NEAR(a.z, b.z, error);
}

Placement anyPlacement() {
    Placement placement;
    placement.scale = 2;
    placement.translation = {100, 200, 300};
    return turned(placement, {}, normalize({1, 2, 3}), 40);
}

TEST(PlacementEdit, QuarterTurnsAboutAnAxis) {
    const Placement quarter = turned({}, {}, {0, 0, 1}, 90);
    expectAt(placed(quarter, {1, 0, 0}), {0, 1, 0});
    expectAt(placed(quarter, {0, 1, 0}), {-1, 0, 0});
    expectAt(placed(quarter, {0, 0, 1}), {0, 0, 1});
}

TEST(PlacementEdit, ThePivotStays) {
    const Placement before = anyPlacement();
    const Vec3 place = placed(before, kPivot);
    expectAt(placed(turned(before, kPivot, {0, 1, 0}, 33), kPivot), place, 1e-9);
    expectAt(placed(scaledTo(before, kPivot, 0.1), kPivot), place, 1e-9);
    EXPECT_EQ(scaledTo(before, kPivot, 0.1).scale, 0.1);
    EXPECT_EQ(turned(before, kPivot, {0, 1, 0}, 33).scale, 2);
}

TEST(PlacementEdit, ManyTurnsStayOrthonormal) {
    Placement placement = anyPlacement();
    for (int i = 0; i < 3600; ++i) placement = turned(placement, kPivot, {0, 0, 1}, 0.1);
    const auto& r = placement.rotation;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(dot(r[i], r[k]), i == k ? 1 : 0, 1e-14);
    expectAt(placed(placement, {1, 1, 1}), placed(anyPlacement(), {1, 1, 1}), 1e-7);
}

} // namespace
} // namespace pointrt
