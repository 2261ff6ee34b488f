// SPDX-License-Identifier: Apache-2.0
// Settings and camera to what the shaders read: everything in render units.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/render_settings.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Camera, sky, caustics and options for one band of rows (first_row, rows) of the image, which is all the
/// film holds.
gpu::FrameParams makeFrameParams(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                                 std::uint32_t first_row, std::uint32_t rows);

/// Puts a box around all that the scene's instances may be hit in into params.reach_low and reach_high.
void setReach(const DeviceScene& scene, gpu::FrameParams& params);

/// Tells params of the scene's shapes.
void setShapes(const DeviceScene& scene, gpu::FrameParams& params);

/// Where the ray through the centre of pixel (x, y) starts, input coordinates: the eye but for parallel projection.
Vec3 centerRayOrigin(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y);

/// Unit direction of that ray, input frame.
Vec3 centerRayDirection(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y);

} // namespace pointrt
