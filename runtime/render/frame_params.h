// SPDX-License-Identifier: Apache-2.0
// Settings and camera as shader parameters, in render units.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/render_settings.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Camera, sky and options for one band of rows (first_row, rows) of the image, for a film of just that band.
gpu::FrameParams makeFrameParams(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                                 std::uint32_t first_row, std::uint32_t rows);

/// Sets params.instances_low and instances_high to the box around all instances.
void setInstanceBounds(const DeviceScene& scene, gpu::FrameParams& params);

/// Sets the shapes of the scene in params.
void setShapes(const DeviceScene& scene, gpu::FrameParams& params);

/// Origin of the ray through the centre of pixel (x, y), input coordinates: the eye, except with parallel projection
/// and in a stereo panorama.
Vec3 centerRayOrigin(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y);

/// Unit direction of that ray, input coordinates.
Vec3 centerRayDirection(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y);

} // namespace pointrt
