// SPDX-License-Identifier: Apache-2.0
// Layers moved and turned by hand.
#pragma once

#include <optional>
#include <span>

#include "runtime/scene/layers.h"

namespace pointrt {

/// Where the handles of a layer stand, in the world: the middle of a scan, shape or box, the place of a light, the
/// point of a clip plane. None for what has no place: suns and measurements.
/// @param scan_centres of the instances, in the coordinates of their files
std::optional<Vec3> layerMiddle(const SceneDescription& scene, LayerId id, std::span<const Vec3> scan_centres);

/// by: in the world.
void moveLayer(SceneDescription& scene, LayerId id, Vec3 by);

/// False if all turns leave it as it is, as those of balls and point lights do.
bool mayTurn(const SceneDescription& scene, LayerId id);

/// Turns the layer about its middle. axis: unit length, in the world
void turnLayer(SceneDescription& scene, LayerId id, Vec3 axis, double degrees, std::span<const Vec3> scan_centres);

} // namespace pointrt
