// SPDX-License-Identifier: Apache-2.0
// Moving and rotating layers by hand.
#pragma once

#include <optional>
#include <span>

#include "runtime/scene/layers.h"

namespace pointrt {

/// The place of a layer's handles, in the world: the middle of a scan, shape or box, the position of a light, the point
/// of a clip plane. None for suns and measurements, which have no place.
/// @param scan_centres of the instances, in the coordinates of their files
std::optional<Vec3> layerMiddle(const SceneDescription& scene, LayerId id, std::span<const Vec3> scan_centres);

/// by: displacement in the world.
void moveLayer(SceneDescription& scene, LayerId id, Vec3 by);

/// False if rotations do not change the layer, as for balls and point lights.
bool mayTurn(const SceneDescription& scene, LayerId id);

/// Rotates the layer about its middle. axis: unit length, in the world
void turnLayer(SceneDescription& scene, LayerId id, Vec3 axis, double degrees, std::span<const Vec3> scan_centres);

} // namespace pointrt
