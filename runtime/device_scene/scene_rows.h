// SPDX-License-Identifier: Apache-2.0
// Materials, shapes and lights of a description as rows for the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/device_scene/device_scene.h"

namespace pointrt {

struct SceneRows {
    std::vector<gpu::Material> materials; ///< the description's, then lamps', then those of each instance
    std::vector<gpu::Shape> shapes;       ///< the description's, then lamps with an area
    std::vector<gpu::Light> lights;       ///< the description's, then the sky image where it has one
    std::vector<gpu::InstanceParams> instances;
    std::vector<bool> casting_shapes;   ///< of the description's, those that throw caustics
    std::uint32_t sky_light = NO_LIGHT; ///< number of the light that stands for the sky image
    std::uint32_t features = 0;         ///< FEATURE_* of shaders/shared/params.h
};

/// For SPEC_SHAPE_KINDS: the kinds of a scene's few shapes.
std::uint32_t shapeKinds(std::span<const gpu::Shape> shapes);

/// description names the files that are in scene, at the places where they stand there. Throws Error kBadInput where an
/// override asks for a material row that its file does not have.
SceneRows makeSceneRows(const DeviceScene& scene, const SceneDescription& description, const RenderSettings& settings);

} // namespace pointrt
