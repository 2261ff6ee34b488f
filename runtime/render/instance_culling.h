// SPDX-License-Identifier: Apache-2.0
// Instance culling: scenes of many instances test each ray against the instances' boxes first, and intersect an
// instance only with the rays that enter its box (shaders/trace/cull.glsl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Instances of a scene and their boxes.
struct CullGroupBoxes {
    std::vector<std::size_t> places; ///< among the scene's instances, at most CULL_INSTANCES
    gpu::CullBoxes boxes{};
};

/// Whether the scene may ever need culling. The instances of sets change as tiles are loaded.
bool mayCull(const DeviceScene& scene);

/// Cull groups of the scene's instances at these places; none if there are so few instances that intersecting each with
/// all rays is faster.
std::vector<CullGroupBoxes> makeCullGroups(const DeviceScene& scene, const std::vector<std::size_t>& places);

/// The boxes of instances of a set, or of whole files, in the frame of the first; at most CULL_INSTANCES.
gpu::CullBoxes makeCullBoxes(const DeviceScene& scene, std::span<const std::size_t> places);

/// Number of boxes that the culling programs of a group of count instances are built for.
std::uint32_t cullProgramSize(std::size_t count);
/// All values of cullProgramSize that the scene's instances need now or may need when tiles are loaded.
std::vector<std::uint32_t> cullProgramSizes(const DeviceScene& scene);

} // namespace pointrt
