// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/clip_planes.h"

#include <algorithm>

#include "runtime/device_scene/render_space.h"
#include "runtime/util/pack.h"

namespace pointrt {
namespace {

/// The half-space in the cube of an instance. In doubles: the two points may be far from the origin of the world.
gpu::vec4 inCube(const HalfSpace& kept, const Placement& placement, const pro_info& frame) {
    const std::array<Vec3, 3>& r = placement.rotation;
    const Vec3 n = kept.normal;
    const Vec3 normal = n.x * r[0] + n.y * r[1] + n.z * r[2]; // turned back
    const Vec3 cube_origin = placed(placement, {frame.origin[0], frame.origin[1], frame.origin[2]});
    return pack(normal, dot(n, kept.point - cube_origin) / (placement.scale * frame.scale));
}

} // namespace

std::vector<HalfSpace> keptOf(const SceneDescription& scene, const InstanceDescription& instance) {
    return instance.clipped ? keptHalfSpaces(scene.clips) : std::vector<HalfSpace>();
}

bool cutsInstances(const SceneDescription& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const InstanceDescription& each) { return !keptOf(scene, each).empty(); });
}

void setClipPlanes(std::span<const HalfSpace> kept, const Placement& placement, const pro_info& frame,
                   gpu::InstanceParams& params) {
    params.grid_words.w = static_cast<std::uint32_t>(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) params.clip_planes[i] = inCube(kept[i], placement, frame);
}

} // namespace pointrt
