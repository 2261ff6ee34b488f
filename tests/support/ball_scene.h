// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// A glass ball and a plastic ball on a floor under a small area light.
inline SceneDescription ballScene() {
    SceneDescription scene;
    scene.materials.resize(2);
    scene.materials[0].kind = MaterialKind::kPlastic;
    scene.materials[1].kind = MaterialKind::kGlass;
    scene.shapes.push_back({ShapeKind::kSphere, {-1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0});
    scene.shapes.push_back({ShapeKind::kSphere, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1});
    scene.shapes.push_back({ShapeKind::kDisc, {0, 0, 0}, {4, 0, 0}, {0, 0, -4}, {0, 1, 0}});
    scene.lights.push_back(SphereLight{{2, 4, 2}, 0.5, {30, 30, 30}});
    return scene;
}

} // namespace pointrt
