// SPDX-License-Identifier: Apache-2.0
// Attributes of the splats that were hit, equal to those of the file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "pointrt/pro_layout.h"
#include "pointrt/trace.hpp"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

const std::string kTiny = POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro"; // see tests/format/tiny_attributes.h

template <typename Number>
std::vector<Number> read(const TraceScene& scene, const std::string& name, const std::vector<std::uint32_t>& splats,
                         const std::vector<std::uint32_t>& instances, std::size_t components = 1) {
    std::vector<Number> values(splats.size() * components);
    scene.readAttribute(name, splats, instances, std::as_writable_bytes(std::span(values)));
    return values;
}

std::string refusalOf(const TraceScene& scene, const std::string& name, std::size_t bytes) {
    const std::vector<std::uint32_t> one{0};
    std::vector<std::byte> values(bytes);
    try {
        scene.readAttribute(name, one, one, values);
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
        return error.what();
    }
    return "nothing was thrown";
}

TEST(SceneAttributes, Match_TheFile) {
    const TraceDevice device;
    const TraceScene scene(device, {kTiny});
    const std::vector<SceneAttribute> all = scene.attributes();
    ASSERT_EQ(all.size(), 5u);
    EXPECT_EQ(all[0].name, "intensity");
    EXPECT_EQ(all[0].type, PRO_TYPE_U16);
    EXPECT_EQ(all[0].bytes, 2u);
    EXPECT_EQ(all[3].name, "rgb16");
    EXPECT_EQ(all[3].components, 3u);
    EXPECT_EQ(all[3].bytes, 6u);
}

TEST(SceneAttributes, AreRead_AtHitsOnly) {
    const TraceDevice device;
    const TraceScene scene(device, {kTiny, kTiny});
    const std::vector<std::uint32_t> splats{3, kNoHit, 1, 0}, instances{0, kNoHit, 1, 1};
    EXPECT_EQ(read<std::uint16_t>(scene, "intensity", splats, instances),
              (std::vector<std::uint16_t>{300, 0, 65535, 0}));
    EXPECT_EQ(read<std::uint16_t>(scene, "rgb16", splats, instances, 3),
              (std::vector<std::uint16_t>{10, 11, 12, 0, 0, 0, 4, 5, 6, 1, 2, 3}));
    const std::vector<double> times = read<double>(scene, "gps_time", splats, instances);
    EXPECT_EQ(times[0], -4.5);
    EXPECT_TRUE(std::isnan(times[1])); // a miss
    EXPECT_TRUE(std::isnan(times[2])); // NaN in the file
    EXPECT_EQ(times[3], 1e9 + 0.25);
}

TEST(SceneAttributes, OfAHit_AreThoseOfItsSplat) {
    const TraceDevice device;
    const TraceScene scene(device, {kTiny});
    const std::vector<double> ray{10.5, 20.75, 31, 0, 0, -1}; // onto splat 0
    std::vector<std::uint32_t> splat(1), instance(1);
    std::vector<double> t(1);
    scene.castRays(std::span<const double>(ray), {}, {.t_hit = t, .splat_ids = splat, .instance_ids = instance});
    EXPECT_NEAR(t[0], 0.5, 1e-5);
    EXPECT_EQ(splat[0], 0u);
    EXPECT_EQ(read<std::uint8_t>(scene, "classification", splat, instance), std::vector<std::uint8_t>{2});
}

TEST(SceneAttributes, Colors_AreWhiteInScansWithout) {
    const TemporaryFolder folder;
    writeScan(folder.file("plane.pro"), planeSplats(4, 0.5f), {});
    const TraceDevice device;
    const TraceScene scene(device, {kTiny, folder.file("plane.pro")});
    const std::vector<std::uint32_t> splats{3, kNoHit, 0, 0}, instances{0, kNoHit, 0, 1};
    std::vector<std::uint8_t> colors(12);
    scene.readColors(splats, instances, colors);
    EXPECT_EQ(colors, (std::vector<std::uint8_t>{128, 64, 32, 0, 0, 0, 255, 0, 0, 255, 255, 255}));
    EXPECT_THROW(scene.readColors(splats, instances, std::span(colors).first(9)), TraceError);
}

TEST(SceneAttributes, RangeAndUnit_AreThoseOfTheFile) {
    const TemporaryFolder folder;
    writeScan(folder.file("plane.pro"), planeSplats(4, 0.5f), {});
    const TraceDevice device;
    const TraceScene scene(device, {kTiny, kTiny});
    EXPECT_EQ(scene.metresPerUnit(), 0.3048);
    EXPECT_EQ(scene.attributes()[0].low, 0);
    EXPECT_EQ(scene.attributes()[0].high, 65535);
    EXPECT_EQ(TraceScene(device, {kTiny, folder.file("plane.pro")}).metresPerUnit(), 0); // plane.pro has no unit
}

TEST(SceneAttributes, OnlySharedOnes_AreTheScenes) {
    const TemporaryFolder folder;
    writeScan(folder.file("plane.pro"), planeSplats(4, 0.5f), {});
    const TraceDevice device;
    const TraceScene both(device, {kTiny, folder.file("plane.pro")});
    EXPECT_TRUE(both.attributes().empty());
    EXPECT_SAYS(refusalOf(both, "intensity", 2), "*intensity*none *common");
    const TraceScene tiny(device, {kTiny});
    EXPECT_SAYS(refusalOf(tiny, "height", 2), "*height*intensity, classification, ");
    EXPECT_SAYS(refusalOf(tiny, "intensity", 1), "intensity: *rows");
}

} // namespace
} // namespace pointrt::test
