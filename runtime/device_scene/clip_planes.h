// SPDX-License-Identifier: Apache-2.0
// A scene's clips as planes in the cubes of its instances (shaders/trace/clip.glsl).
#pragma once

#include <span>

#include "runtime/device_scene/device_scan.h"
#include "runtime/scene/scene_description.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {

/// Whether the clips cut any instance: programs are specialised for that.
bool cutsInstances(const SceneDescription& scene);

/// Clips the hits of an instance of file, by the half-spaces that may cut it.
/// @param kept at most MAX_CLIP_PLANES
void setClipPlanes(std::span<const HalfSpace> kept, const Placement& placement, const DeviceScan& file,
                   gpu::InstanceParams& params);

} // namespace pointrt
