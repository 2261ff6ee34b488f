// SPDX-License-Identifier: Apache-2.0
// The materials, shapes, lights and instances of a scene as table rows for the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/device_scene/device_scene.h"

namespace pointrt {

struct SceneRows {
    std::vector<gpu::Material> materials; ///< of the description, of its area lights, of each instance
    std::vector<gpu::Shape> shapes;       ///< of the description, then of its area lights
    std::vector<gpu::Light> lights;       ///< of the description, then of its sky image
    std::vector<gpu::InstanceParams> instances;
    std::vector<bool> casting_shapes;   ///< [shownShapes] whether each casts caustics
    std::uint32_t sky_light = NO_LIGHT; ///< number of the sky image's light
    std::uint32_t features = 0;         ///< FEATURE_* of shaders/shared/params.h
};

/// SPEC_SHAPE_KINDS: the kinds of a scene's shapes, 0 if there are too many.
std::uint32_t shapeKinds(std::span<const gpu::Shape> shapes);

/// @param description has the files and placements of scene
/// Throws Error kBadInput if an override names a material row that its file does not have.
SceneRows makeSceneRows(const DeviceScene& scene, const SceneDescription& description, const RenderSettings& settings);

} // namespace pointrt
