// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/clip_planes.h"

#include <algorithm>

#include "runtime/device_scene/render_space.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/scene/kept.h"
#include "runtime/util/pack.h"

namespace pointrt {
namespace {

/// The half-space in the cube of an instance. Uses doubles, since the two points may be far from the origin of the
/// world.
gpu::vec4 inCube(const HalfSpace& kept, const Placement& placement, const pro_info& frame) {
    const Vec3 cube_origin = placed(placement, {frame.origin[0], frame.origin[1], frame.origin[2]});
    return pack(unrotated(placement, kept.normal),
                dot(kept.normal, kept.point - cube_origin) / (placement.scale * frame.scale));
}

/// Whether a half-space may cut anything of an instance. False if all corners of its bounds are inside the half-space,
/// farther from the plane than discs can extend beyond the bounds. Gaussians extend farther.
bool mayCut(const HalfSpace& kept, const Placement& placement, const DeviceScan& file) {
    if (file.is_gaussian) return true;
    const Bounds bounds = placedBounds(placement, file.info);
    const Vec3 center = 0.5 * (bounds.lo + bounds.hi), half = 0.5 * (bounds.hi - bounds.lo);
    const double reach =
        dot(absolute(kept.normal), half) + 2 * placement.scale * file.info.scale * file.info.radius_max;
    return dot(kept.normal, center - kept.point) < reach;
}

} // namespace

bool cutsInstances(const SceneDescription& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const InstanceDescription& each) { return !keptOf(scene.clips, each).empty(); });
}

void setClipPlanes(std::span<const HalfSpace> kept, const Placement& placement, const DeviceScan& file,
                   gpu::InstanceParams& params) {
    std::uint32_t count = 0;
    for (const HalfSpace& each : kept)
        if (mayCut(each, placement, file)) params.clip_planes[count++] = inCube(each, placement, tracedFrame(file));
    params.grid_words.w = count;
}

} // namespace pointrt
