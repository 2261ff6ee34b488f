// SPDX-License-Identifier: Apache-2.0
// Layers moved and turned, and shapes put into a scene.
#include "runtime/window/edit/layer_transform.h"

#include <gtest/gtest.h>

#include "runtime/device_scene/render_space.h"
#include "runtime/window/edit/shape_edit.h"

namespace pointrt {
namespace {

constexpr Vec3 kBy{1, -2, 3}, kUpwards{0, 0, 1};
const std::vector<Vec3> kCentres{{5, 6, 7}};

void expectPlaced(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

/// A layer of each kind that has a place.
SceneDescription everything() {
    SceneDescription scene;
    scene.instances.push_back({"a.pro", {}, {}, {}});
    ShapeDescription box{ShapeKind::kBox, {1, 1, 1}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0};
    scene.shapes = {box};
    PointLight point;
    SpotLight spot;
    spot.direction = {1, 0, 0};
    QuadLight quad;
    quad.u = {1, 0, 0};
    quad.v = {0, 1, 0};
    scene.lights = {point, spot, quad};
    scene.clips = {clipBox({0, 0, 0, 2, 4, 6}), ClipDescription{ClipPlane{{1, 2, 3}, {1, 0, 0}}}};
    return scene;
}

TEST(LayerTransform, MovesEveryKindByTheSame) {
    SceneDescription scene = everything();
    for (const LayerId id : layersOf(scene)) {
        const std::optional<Vec3> before = layerMiddle(scene, id, kCentres);
        ASSERT_TRUE(before) << layerName(scene, id);
        moveLayer(scene, id, kBy);
        expectPlaced(*layerMiddle(scene, id, kCentres), *before + kBy);
    }
}

TEST(LayerTransform, TurnsAboutTheMiddle) {
    SceneDescription scene = everything();
    for (const LayerId id : layersOf(scene)) {
        if (!mayTurn(scene, id)) continue;
        const Vec3 middle = *layerMiddle(scene, id, kCentres);
        turnLayer(scene, id, kUpwards, 90, kCentres);
        expectPlaced(*layerMiddle(scene, id, kCentres), middle);
    }
    expectPlaced(scene.shapes[0].u, {0, 2, 0});
    expectPlaced(scene.shapes[0].v, {-1, 0, 0});
    expectPlaced(std::get<SpotLight>(scene.lights[1]).direction, {0, 1, 0});
    expectPlaced(std::get<QuadLight>(scene.lights[2]).v, {-1, 0, 0});
    expectPlaced(std::get<ClipPlane>(scene.clips[1].form).normal, {0, 1, 0});
    // world = rotation * box: the box's x axis points along y
    expectPlaced({std::get<ClipBox>(scene.clips[0].form).rotation[0].x,
                  std::get<ClipBox>(scene.clips[0].form).rotation[1].x,
                  std::get<ClipBox>(scene.clips[0].form).rotation[2].x},
                 {0, 1, 0});
    expectPlaced(placed(scene.instances[0].placement, kCentres[0] + Vec3{1, 0, 0}), kCentres[0] + Vec3{0, 1, 0});
}

TEST(LayerTransform, ALittleTurnsManyTimesStaysARotation) {
    SceneDescription scene = everything();
    for (int i = 0; i < 36000; ++i) turnLayer(scene, {LayerKind::kScan, 0}, normalize({1, 2, 3}), 0.01, kCentres);
    const auto& rows = scene.instances[0].placement.rotation;
    EXPECT_NEAR(length(rows[0]), 1, 1e-12);
    EXPECT_NEAR(dot(rows[0], rows[1]), 0, 1e-12);
    EXPECT_LT(length(rows[0] - Vec3{1, 0, 0}), 1e-6) << "a full turn";
}

TEST(LayerTransform, BallsAndPointLightsDoNotTurnAndSunsHaveNoPlace) {
    SceneDescription scene = everything();
    scene.shapes[0].kind = ShapeKind::kSphere;
    EXPECT_FALSE(mayTurn(scene, {LayerKind::kShape, 0}));
    EXPECT_FALSE(mayTurn(scene, {LayerKind::kLight, 0}));
    EXPECT_TRUE(mayTurn(scene, {LayerKind::kLight, 1}));
    scene.lights = {SunLight{{0, 0, 1}, 1, {1, 1, 1}}};
    EXPECT_FALSE(layerMiddle(scene, {LayerKind::kLight, 0}, kCentres));
}

TEST(ShapeEdit, ShapesRestOnTheSurface) {
    const Vec3 normal = normalize({1, 0, 2});
    for (const ShapeKind kind : kInsertedShapes) {
        SceneDescription scene;
        addShape(scene, kind, {{3, 4, 5}, normal, kUpwards, {0, -1, 0}, 2});
        const ShapeDescription& shape = scene.shapes.back();
        const double reach = reachAlong(shape, normal);
        EXPECT_GT(reach, 0.4);
        expectPlaced(shape.center, Vec3{3, 4, 5} + reach * normal);
        EXPECT_EQ(scene.materials.at(shape.material).name, "shape 1");
    }
}

TEST(ShapeEdit, ReachesAreThoseOfTheForms) {
    ShapeDescription shape{ShapeKind::kBox, {}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, 0};
    const Vec3 diagonal = normalize({1, 1, 1});
    EXPECT_NEAR(reachAlong(shape, diagonal), 6 / std::sqrt(3.0), 1e-12) << "a corner of the box";
    shape = {ShapeKind::kSphere, {}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0};
    EXPECT_NEAR(reachAlong(shape, diagonal), 2, 1e-12);
    shape = {ShapeKind::kDisc, {}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, 0};
    EXPECT_NEAR(reachAlong(shape, kUpwards), 0, 1e-12);
    EXPECT_NEAR(reachAlong(shape, diagonal), 2 * std::sqrt(2.0 / 3), 1e-12);
}

TEST(ShapeEdit, MaterialsAreNamedApartAndRoomIsLimited) {
    SceneDescription scene;
    while (mayAddShape(scene)) addShape(scene, ShapeKind::kSphere, {{}, kUpwards, kUpwards, {1, 0, 0}, 1});
    EXPECT_EQ(scene.shapes.size(), 64u);
    EXPECT_EQ(scene.materials.back().name, "shape 64");
}

} // namespace
} // namespace pointrt
