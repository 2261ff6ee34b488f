// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/scene_world.h"

#include <map>

#include "format/base/require_pro.h"
#include "format/crs/metadata_crs.h"
#include "format/set/tile_set.h"
#include "pointrt/studies.hpp"
#include "runtime/cast/translated.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

SceneWorld worldOfSet(const std::string& folder) {
    const TileSet set = readTileSet(folder);
    return {{set.up[0], set.up[1], set.up[2]}, set.crs, {}, set.oriented};
}

SceneWorld worldOfFile(const std::string& path) {
    requirePro(path);
    const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
    const float* up = file.world().up;
    return {{double{up[0]}, double{up[1]}, double{up[2]}},
            crsOfMetadata(file.metadata()),
            {},
            (file.info().flags & PRO_FLAG_ORIENTED) != 0};
}

SceneWorld worldOfScan(const std::string& path) {
    SceneWorld world = isTileSet(path) ? worldOfSet(path) : worldOfFile(path);
    if (world.up != Vec3{}) world.up = normalize(world.up);
    return world;
}

SceneWorld worldOfScene(const std::string& path) {
    const SceneDescription scene = readSceneFile(path);
    std::map<std::string, SceneWorld> scans;
    SceneWorld world;
    for (const InstanceDescription& each : scene.instances) {
        const auto [found, is_new] = scans.try_emplace(each.path);
        if (is_new) found->second = worldOfScan(each.path);
        const SceneWorld& scan = found->second;
        if (world.up == Vec3{} && scan.up != Vec3{}) world.up = turned(each.placement, scan.up);
        if (world.crs.empty() && !scan.crs.empty()) {
            world.crs = scan.crs;
            world.placement = each.placement;
        }
        world.oriented = world.oriented && scan.oriented;
    }
    if (scene.up) world.up = *scene.up;
    return world;
}

} // namespace

SceneWorld sceneWorld(const std::string& path) {
    return !isTileSet(path) && isSceneFile(path) ? worldOfScene(path) : worldOfScan(path);
}

std::array<double, 3> scanUp(const std::string& path) {
    const Vec3 up = translated([&] { return sceneWorld(path); }).up;
    if (up == Vec3{}) return {0, 0, 1};
    return {up.x, up.y, up.z};
}

Sides sidesOf(const std::vector<std::string>& paths) {
    for (const std::string& path : paths)
        if (!translated([&] { return sceneWorld(path); }).oriented) return Sides::kBoth;
    return Sides::kFront;
}

} // namespace pointrt
