// SPDX-License-Identifier: Apache-2.0
// A scene's clips as planes in the cubes of its instances (shaders/trace/clip.glsl).
#pragma once

#include <span>

#include "pointrt/pro.h"
#include "runtime/scene/scene_description.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {

/// What the scene's clips keep of an instance; empty if they do not cut it.
std::vector<HalfSpace> keptOf(const SceneDescription& scene, const InstanceDescription& instance);

/// Whether the clips cut any instance: programs are specialised for that.
bool cutsInstances(const SceneDescription& scene);

/// Clips the hits of an instance.
/// @param kept at most MAX_CLIP_PLANES
/// @param frame tracedFrame of its file
void setClipPlanes(std::span<const HalfSpace> kept, const Placement& placement, const pro_info& frame,
                   gpu::InstanceParams& params);

} // namespace pointrt
