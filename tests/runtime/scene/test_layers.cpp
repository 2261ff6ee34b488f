// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/layers.h"

#include <gtest/gtest.h>

#include "format/base/error.h"
#include "runtime/scene/kept.h"

namespace pointrt {
namespace {

/// Two scans, a ball on a studio floor, a lamp and a plane.
SceneDescription fullScene() {
    SceneDescription scene;
    scene.instances.push_back({"scans/nave.pro", {}, {}, {}});
    scene.instances.push_back({"scans/tower.pro", {}, {}, {}});
    scene.shapes.resize(2);
    scene.shapes[1].of_surroundings = true;
    scene.lights.emplace_back(PointLight{});
    scene.clips.push_back({ClipPlane{}});
    scene.measures.push_back({{{0, 0, 0}, {3, 4, 0}}});
    return scene;
}

constexpr LayerId kTower{LayerKind::kScan, 1}, kOrb{LayerKind::kShape, 0}, kLamp{LayerKind::kLight, 0},
    kPlane{LayerKind::kClip, 0};

TEST(Layers, HaveNames) {
    SceneDescription scene = fullScene();
    EXPECT_EQ(layersOf(scene).size(), 7u);
    EXPECT_EQ(layerName(scene, kTower), "tower.pro");
    EXPECT_EQ(layerName(scene, kLamp), "light 1");
    layerAt(scene, kLamp).name = "window";
    EXPECT_EQ(layerNamed(scene, "window"), kLamp);
    EXPECT_EQ(layerNamed(scene, "clip 1"), kPlane);
    EXPECT_FALSE(layerNamed(scene, "light 1"));
}

TEST(Layers, AreHiddenByName) {
    SceneDescription scene = fullScene();
    hideLayers(scene, {"tower.pro", "light 1", "clip 1"});
    EXPECT_FALSE(isLayerVisible(scene, kTower) || isVisible(scene.lights[0]) || scene.clips[0].enabled);
    EXPECT_TRUE(isLayerVisible(scene, kOrb));
    setLayerVisible(scene, kTower, true);
    EXPECT_TRUE(scene.instances[1].visible);
    try {
        hideLayers(scene, {"spire"});
        FAIL() << "no layer is named spire";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
    }
}

TEST(Layers, HiddenScansHaveNothingToHit) {
    SceneDescription scene = fullScene();
    scene.clips.clear();
    EXPECT_TRUE(keptOf(scene.clips, scene.instances[0]).empty()) << "uncut";
    scene.instances[0].visible = false;
    const std::vector<HalfSpace> kept = keptOf(scene.clips, scene.instances[0]);
    for (const Vec3 point : {Vec3{}, Vec3{1e12, 1e12, 1e12}, Vec3{-1e12, 0, 0}}) EXPECT_FALSE(isKept(kept, point));
}

TEST(Layers, AreDeletedUnlessLockedOrTheLast) {
    SceneDescription scene = fullScene();
    scene.clips[0].layer.locked = true;
    EXPECT_FALSE(mayDelete(scene, kPlane));
    deleteLayer(scene, kTower);
    EXPECT_EQ(scene.instances.size(), 2u) << "numbers of scans are those on the device";
    EXPECT_EQ(layersOf(scene).size(), 6u);
    EXPECT_FALSE(keptOf({}, scene.instances[1]).empty()) << "hidden";
    deleteLayer(scene, kLamp);
    EXPECT_TRUE(scene.lights.empty());
    deleteLayer(scene, kOrb);
    EXPECT_EQ(scene.shapes.size(), 1u);
    EXPECT_FALSE(mayDelete(scene, {LayerKind::kScan, 0})) << "a scene needs one";
}

} // namespace
} // namespace pointrt
