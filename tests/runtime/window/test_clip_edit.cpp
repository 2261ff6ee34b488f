// SPDX-License-Identifier: Apache-2.0
// Clips as the window edits them.
#include "runtime/window/edit/clip_edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/window/edit/outline_job.h"

namespace pointrt {
namespace {

TEST(ClipEdit, ANewBoxCutsNothing) {
    const std::vector<HalfSpace> kept = keptHalfSpaces(std::vector{newClipBox({0, 0, 0}, {1, 2, 0})}); // a flat scan
    for (const Vec3 corner : {Vec3{0, 0, 0}, Vec3{1, 2, 0}, Vec3{1, 0, 0}}) EXPECT_TRUE(isKept(kept, corner));
}

TEST(ClipEdit, APlaneCutsAwayWhatIsInFrontOfThePick) {
    // a ceiling seen from above: the clip removes what is above it
    const ClipDescription plane =
        newClipPlane(ClipSurface{{1, 2, 3}, normalize({0.1, 0, -1})}, {0, 0.2, -0.9}, {}, {0, 0, 1});
    EXPECT_EQ(std::get<ClipPlane>(plane.form), (ClipPlane{{1, 2, 3}, {0, 0, -1}}));
    const ClipDescription level = newClipPlane({}, {1, 0, 0}, {5, 5, 5}, {0, 0, 1});
    EXPECT_EQ(std::get<ClipPlane>(level.form), (ClipPlane{{5, 5, 5}, {0, 0, -1}}));
}

/// The corner of a box that is low or high along each axis, world units.
Vec3 cornerOf(const ClipBox& box, bool x, bool y, bool z) {
    const Vec3 middle = 0.5 * (box.low + box.high);
    const Vec3 from = Vec3{x ? box.high.x : box.low.x, y ? box.high.y : box.low.y, z ? box.high.z : box.low.z} - middle;
    return middle + Vec3{dot(box.rotation[0], from), dot(box.rotation[1], from), dot(box.rotation[2], from)};
}

TEST(ClipEdit, MovingASideOfATurnedBoxLeavesTheOthers) {
    const double c = std::cos(0.5), s = std::sin(0.5);
    ClipBox box{{0, 0, 0}, {2, 3, 4}, {Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
    const ClipBox before = box;
    setBoxSide(box, 0, true, 3, 0.1);
    EXPECT_LT(length(cornerOf(box, false, false, false) - cornerOf(before, false, false, false)), 1e-12);
    const Vec3 moved = cornerOf(box, true, false, false) - cornerOf(before, true, false, false);
    EXPECT_LT(length(moved - Vec3{c, s, 0}), 1e-12); // by 1 along the turned axis
}

TEST(OutlineJob, NamesPlanesSquareToAnAxis) {
    EXPECT_EQ(planeOption({{1, 2, 3.25}, {0, 0, -1}}), "z=3.25");
    EXPECT_EQ(planeOption({{637000.5, 2, 3}, {1, 0, 0}}), "x=637000.5");
    EXPECT_FALSE(planeOption({{1, 2, 3}, normalize({1, 1, 0})}));
}

TEST(ClipEdit, SidesDoNotPassEachOther) {
    ClipBox box{{0, 0, 0}, {2, 3, 4}};
    setBoxSide(box, 2, false, 9, 0.1);
    EXPECT_NEAR(box.low.z, 3.9, 1e-12);
    setBoxSide(box, 1, true, -9, 0.1);
    EXPECT_NEAR(box.high.y, 0.1, 1e-12);
}

} // namespace
} // namespace pointrt
