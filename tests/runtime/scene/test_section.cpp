// SPDX-License-Identifier: Apache-2.0
// Clips as half-spaces, and sections as clips and views.
#include "runtime/scene/section.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pointrt {
namespace {

constexpr Vec3 kXAxis{1, 0, 0}, kYAxis{0, 1, 0}, kZAxis{0, 0, 1};

Section sectionOf(const std::string& text, Vec3 up) { return makeSection(parseSection(text), up); }

bool keeps(const Section& section, Vec3 point) { return isKept(keptHalfSpaces(section.clips), point); }

TEST(Clip, ATurnedBoxKeepsWhatIsInside) {
    ClipBox box{
        {-2, -1, -1}, {4, 1, 1}, {Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}}; // x turned to y, about (1, 0, 0)
    const std::vector<HalfSpace> kept = keptHalfSpaces(std::vector<ClipDescription>{{box}});
    EXPECT_EQ(kept.size(), 6u);
    for (const Vec3 inside : {Vec3{1, 2.9, 0}, Vec3{1, -2.9, 0}, Vec3{1.9, 0, 0.9}, Vec3{0.1, 0, 0}})
        EXPECT_TRUE(isKept(kept, inside)) << inside.x << " " << inside.y;
    for (const Vec3 outside : {Vec3{1, 3.1, 0}, Vec3{2.1, 0, 0}, Vec3{3.9, 0, 0}, Vec3{1, 0, 1.1}})
        EXPECT_FALSE(isKept(kept, outside)) << outside.x << " " << outside.y;
}

TEST(Clip, OfSeveralWhatIsInsideAllRemains) {
    std::vector<ClipDescription> clips = {clipBox({0, 0, 0, 1, 1, 1}), {ClipPlane{{0.5, 0, 0}, kXAxis}}};
    EXPECT_EQ(countHalfSpaces(clips), 7u);
    EXPECT_FALSE(isKept(keptHalfSpaces(clips), {0.4, 0.5, 0.5}));
    EXPECT_TRUE(isKept(keptHalfSpaces(clips), {0.6, 0.5, 0.5}));
    clips[1].enabled = false;
    EXPECT_TRUE(isKept(keptHalfSpaces(clips), {0.4, 0.5, 0.5}));
}

TEST(Section, AFloorPlanIsSeenFromAboveWithNorthUp) {
    const Section plan = sectionOf("z=1.2", kZAxis);
    EXPECT_EQ(plan.side, kZAxis);
    EXPECT_EQ(plan.up, kYAxis);
    EXPECT_TRUE(keeps(plan, {9, 9, 1.1}));
    EXPECT_FALSE(keeps(plan, {9, 9, 1.3}));
    const Section ceiling = sectionOf("-z=1.2", kZAxis);
    EXPECT_EQ(ceiling.side, -1.0 * kZAxis);
    EXPECT_TRUE(keeps(ceiling, {9, 9, 1.3}));
    EXPECT_EQ(sectionOf("y=1.2", kYAxis).side, kYAxis); // y is up: no difference along y
}

TEST(Section, TheOtherCoordinateGrowsToTheRight) {
    const struct {
        const char* text;
        Vec3 up, right;
    } cases[] = {{"x=5", kZAxis, kYAxis}, {"y=5", kZAxis, kXAxis}, {"x=5", kYAxis, kZAxis}, {"z=5", kYAxis, kXAxis}};
    for (const auto& each : cases) {
        const Section section = sectionOf(each.text, each.up);
        EXPECT_EQ(cross(-1.0 * section.side, section.up), each.right) << each.text;
        EXPECT_TRUE(keeps(section, Vec3{5, 5, 5} - section.side));
        EXPECT_FALSE(keeps(section, Vec3{5, 5, 5} + section.side));
    }
}

TEST(Section, ASliceIsHalfOnEitherSide) {
    const Section slice = sectionOf("y=3:0.5", kZAxis);
    for (const double y : {2.76, 3.24}) EXPECT_TRUE(keeps(slice, {7, y, 7}));
    for (const double y : {2.74, 3.26}) EXPECT_FALSE(keeps(slice, {7, y, 7}));
}

TEST(Section, ALineGoesFromLeftToRight) {
    const Section section = sectionOf("1,1,4,5", kZAxis); // along (3, 4)
    EXPECT_NEAR(dot(section.side, Vec3{0.8, -0.6, 0}), 1, 1e-12);
    EXPECT_EQ(section.up, kZAxis);
    EXPECT_TRUE(keeps(section, {0, 5, 0}));
    EXPECT_FALSE(keeps(section, {5, 0, 0}));
}

TEST(Section, RefusesWhatIsNone) {
    for (const char* text : {"", "z", "z=", "z=1:", "z=1:0", "z=1:-1", "w=1", "z=nan", "z=1e13", "--z=1", "1,2,3",
                             "1,2,3,4,5", "1,2,1,2", "1,2,3,x", "z=1:2:3", "=1", "-=1"})
        EXPECT_THROW(parseSection(text), std::invalid_argument) << text;
}

} // namespace
} // namespace pointrt
