// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/without_effect.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

using Lines = std::vector<std::string>;

/// The options with which the lines begin.
Lines named(const Options& options, const SceneTraits& scene) {
    Lines names;
    for (const std::string& line : optionsWithoutEffect(options, scene))
        names.push_back(line.substr(0, line.find(' ')));
    return names;
}

TEST(WithoutEffect, IsSilentAboutOptionsNotGiven) {
    EXPECT_EQ(named({}, {false, false, false, false}), Lines{});
    EXPECT_EQ(named({}, {}), Lines{});
}

TEST(WithoutEffect, HardwareRaysNeedBoxes) {
    Options options;
    options.traversal = Traversal::kHardware;
    EXPECT_EQ(named(options, {}), Lines{});
    EXPECT_EQ(named(options, {.has_walked = true}), Lines{"--rays"});
    options.traversal = Traversal::kAuto;
    EXPECT_EQ(named(options, {.has_walked = true}), Lines{});
}

TEST(WithoutEffect, MemoryAndDetailNeedTileSets) {
    Options options;
    options.memory = 1 << 30;
    options.choices.detail = 0;
    EXPECT_EQ(named(options, {}), (Lines{"--memory", "--detail"}));
    EXPECT_EQ(named(options, {.has_tiles = true}), Lines{});
}

TEST(WithoutEffect, BouncesNeedSecondaryRays) {
    Options options;
    options.choices.bounces = 8;
    EXPECT_EQ(named(options, {}), Lines{"--bounces"});
    EXPECT_EQ(named(options, {.has_secondary_rays = true}), Lines{});
    options.choices.bounces = 0;
    EXPECT_EQ(named(options, {}), Lines{}) << "0 bounces are valid without secondary rays";
}

TEST(WithoutEffect, LightsNeedAnIntegratorThatUsesThem) {
    Options options;
    options.choices.lights = 3;
    options.choices.bounces = 2;
    EXPECT_EQ(named(options, {.uses_lights = false}), (Lines{"--lights", "--bounces"}));
    EXPECT_EQ(named(options, {.has_secondary_rays = true}), Lines{});
}

} // namespace
} // namespace pointrt
