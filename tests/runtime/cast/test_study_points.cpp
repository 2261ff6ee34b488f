// SPDX-License-Identifier: Apache-2.0
// Studies of tile sets and scene files: points, up and north.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "pointrt/studies.hpp"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/runtime/rays/set_scenes.h"

namespace pointrt::test {
namespace {

class StudyScenes : public testing::Test {
protected:
    static void SetUpTestSuite() { ball = new SphereInTiles; }
    static void TearDownTestSuite() {
        delete ball;
        ball = nullptr;
    }

    static ScenePoints allOf(const std::vector<std::string>& paths, std::size_t most = ScenePointReader::kPoints) {
        ScenePointReader reader(paths);
        ScenePoints all;
        for (ScenePoints some; reader.next(some, most);) {
            EXPECT_LE(some.radii.size(), most);
            const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
            add(all.positions, some.positions);
            add(all.normals, some.normals);
            add(all.radii, some.radii);
            add(all.noise, some.noise);
            add(all.splat_ids, some.splat_ids);
            add(all.instance_ids, some.instance_ids);
            add(all.tile_ids, some.tile_ids);
        }
        return all;
    }

    static Vec3 positionOf(const ScenePoints& points, std::size_t i) {
        return {points.positions[3 * i], points.positions[3 * i + 1], points.positions[3 * i + 2]};
    }

    /// A plane that faces up in its file, rotated about x by 90 degrees to face -y, at half size.
    std::string turnedScene() const {
        writeScan(folder.file("plane.pro"), planeSplats(20, 0.5f), {});
        folder.write("scene.toml", "[[instance]]\nfile = \"plane.pro\"\n[[instance]]\nfile = \"plane.pro\"\n"
                                   "rotate = { axis = [1, 0, 0], degrees = 90 }\nscale = 0.5\ntranslate = [7, 8, 9]\n");
        return folder.file("scene.toml");
    }

    static inline SphereInTiles* ball = nullptr;
    TemporaryFolder folder;
};

TEST_F(StudyScenes, Points_OfASetComeOnce) {
    const ScenePoints points = allOf({ball->tiles()}, 777);
    ASSERT_EQ(points.radii.size(), SphereInTiles::kSplats);
    const TraceDevice device;
    const TraceScene scene(device, {ball->tiles()});
    std::vector<std::byte> bytes(points.radii.size() * sizeof(std::uint32_t));
    scene.readAttribute("number", points.splat_ids, points.instance_ids, points.tile_ids, bytes);
    std::vector<bool> met(points.radii.size());
    for (std::size_t i = 0; i < points.radii.size(); ++i) {
        std::uint32_t number;
        std::memcpy(&number, bytes.data() + i * sizeof number, sizeof number);
        ASSERT_LT(number, met.size());
        EXPECT_FALSE(met[number]);
        met[number] = true;
        ASSERT_LT(length(positionOf(points, i) - ball->points[number]), 1e-3 * ball->splat_radius);
        EXPECT_NEAR(points.radii[i], ball->splat_radius, 0.02 * ball->splat_radius);
    }
    EXPECT_NEAR(medianRadius({ball->tiles()}), ball->splat_radius, 0.02 * ball->splat_radius);
    EXPECT_NEAR(medianRadius({ball->whole()}), ball->splat_radius, 0.02 * ball->splat_radius);
}

TEST_F(StudyScenes, TiledBall_MatchesTheFormulas) {
    const TraceDevice device;
    const ScenePoints points = allOf({ball->tiles()});
    const StudyRules rules{.sides = sidesOf({ball->tiles()})};
    const Vec3 sun = normalize({1, -2, 1.5}), eye = ball->center + 2.5 * SphereInTiles::kRadius * normalize({-1, 1, 3});
    for (const std::uint64_t memory : {SceneOptions{}.memory, 2 * ball->largestTile()}) {
        const TraceScene scene(device, {ball->tiles()}, {memory});
        std::vector<double> lit(points.radii.size());
        std::vector<std::uint8_t> seen(points.radii.size());
        sumLights(scene, points.rows(), {{sun.x, sun.y, sun.z}, {1}}, rules, lit);
        testSight(scene, points.rows(), {{eye.x, eye.y, eye.z}}, rules, seen);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const Vec3 outwards = normalize(positionOf(points, i) - ball->center);
            // excludes points within 8 radii of the terminator, which see both sides
            const double rim = 8 * ball->splat_radius / SphereInTiles::kRadius;
            const double to_sun = dot(outwards, sun), to_eye = dot(outwards, normalize(eye - positionOf(points, i)));
            if (std::abs(to_sun) > rim) wrong += (lit[i] > 0) != (to_sun > 0);
            if (std::abs(to_eye) > rim) wrong += (seen[i] > 0) != (to_eye > 0);
        }
        EXPECT_EQ(wrong, 0u) << memory;
    }
}

TEST_F(StudyScenes, Instances_AreAtTheirPlacements) {
    const ScenePoints points = allOf({turnedScene()});
    const ScanPoints own = scanPoints(folder.file("plane.pro"));
    ASSERT_EQ(points.radii.size(), 2 * own.radii.size());
    for (std::size_t i = 0; i < own.radii.size(); ++i) {
        const std::size_t k = own.radii.size() + i;
        const Vec3 is = positionOf(points, k);
        EXPECT_EQ(points.instance_ids[i] + 10 * points.instance_ids[k], 10u);
        EXPECT_EQ(points.tile_ids[k], kNoHit);
        EXPECT_EQ(positionOf(points, i).y, own.positions[3 * i + 1]);
        EXPECT_NEAR(is.x, 7 + 0.5 * own.positions[3 * i], 1e-6);
        EXPECT_NEAR(is.y, 8 - 0.5 * own.positions[3 * i + 2], 1e-6);
        EXPECT_NEAR(is.z, 9 + 0.5 * own.positions[3 * i + 1], 1e-6);
        EXPECT_NEAR(points.normals[3 * k + 1], -1, 1e-6);
        EXPECT_NEAR(points.radii[k], 0.5 * static_cast<double>(own.radii[i]), 1e-6);
    }
    EXPECT_EQ(sidesOf({turnedScene()}), Sides::kFront);
}

TEST_F(StudyScenes, UpAndNorth_FollowThePlacement) {
    EXPECT_EQ(scanUp(turnedScene()), (std::array<double, 3>{0, 0, 1})); // the file has no up
    const auto sceneOf = [&](const std::string& instance, const std::string& head = "") {
        return folder.write(
            "up.toml", head + "[[instance]]\nfile = \"" POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro\"\n" + instance);
    };
    const std::array<double, 3> own = scanUp(POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro");
    const std::array<double, 3> turned = scanUp(sceneOf("rotate = { axis = [0, 0, 1], degrees = 90 }\n"));
    EXPECT_NEAR(turned[0], -own[1], 1e-6);
    EXPECT_NEAR(turned[1], own[0], 1e-6);
    EXPECT_NEAR(turned[2], own[2], 1e-6);
    EXPECT_EQ(scanUp(sceneOf("", "up = \"x\"\n")), (std::array<double, 3>{1, 0, 0}));
}

TEST_F(StudyScenes, ChangedTile_IsRefused) {
    TemporaryFolder copy;
    std::filesystem::copy(ball->tiles(), copy.file("copy.proset"), std::filesystem::copy_options::recursive);
    const SetTile* last = nullptr;
    for (const SetTile& each : ball->set.tiles)
        if (each.isOriginal()) last = &each;
    std::filesystem::remove(copy.file("copy.proset/" + last->file));
    EXPECT_THROW(allOf({copy.file("copy.proset")}), TraceError);
    EXPECT_THROW(allOf({copy.file("gone.pro")}), TraceError);
    EXPECT_THROW(allOf({}), TraceError);
}

} // namespace
} // namespace pointrt::test
