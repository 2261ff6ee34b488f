// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/pick_details.h"

#include <filesystem>

#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// The inverse of a rotation with orthonormal rows.
Vec3 unrotated(const Placement& placement, Vec3 v) {
    return v.x * placement.rotation[0] + v.y * placement.rotation[1] + v.z * placement.rotation[2];
}

void describeSplat(const DeviceScene& scene, const Pick& pick, PickedPoint& point) {
    const Instance& instance = scene.instances.at(pick.owner);
    const Placement& placement = scene.description.instances.at(pick.owner).placement;
    const DeviceScan& file = scene.files.at(instance.file);
    pro_splat splat{};
    pro_splat_decode(file.view.splats + std::size_t{4} * pick.splat, file.info.radius_max, file.info.radius_step,
                     &splat);
    point.owner = std::filesystem::path(file.path).filename().string();
    point.position = unrotated(placement, pick.position - placement.translation) * (1 / placement.scale);
    point.normal = unrotated(placement, pick.normal);
    point.radius = double{splat.radius} * file.info.scale;
    if (file.info.flags & PRO_FLAG_COLOR) point.color = {splat.color[0], splat.color[1], splat.color[2]};
}

} // namespace

PickedPoint describePick(const DeviceScene& scene, const Pick& pick) {
    PickedPoint point;
    point.splat = pick.splat;
    point.position = pick.position;
    point.normal = pick.normal;
    point.distance = pick.distance;
    if (pick.owner == OWNER_SHAPES)
        point.owner = "shape " + std::to_string(pick.splat + 1);
    else
        describeSplat(scene, pick, point);
    return point;
}

} // namespace pointrt
