// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pooled_tiles.h"

#include <algorithm>

#include "runtime/render/instance_culling.h"

namespace pointrt {
namespace {

bool isPooled(const DeviceScene& scene, const Instance& instance) {
    const DeviceScan& file = scene.files[instance.file];
    return instance.tile && file.range.block && instancePages(scene, instance) == pagedBuffers(file);
}

/// Traits that all tiles of a group share, so that they use the same programs. Unnecessary traits cost time but do not
/// change the picture.
InstanceTraits sharedTraits(InstanceTraits traits) {
    traits.uneven = traits.has_balls = false;
    traits.pooled_tiles = 0;
    return traits;
}

/// The last group whose programs suit the tile; null if no group does, or if that group is full.
PooledGroup* groupFor(const DeviceScene& scene, const Instance& tile, std::vector<PooledGroup>& groups) {
    const InstanceTraits traits = sharedTraits(traitsOf(scene, tile));
    const auto group = std::find_if(groups.rbegin(), groups.rend(), [&](const PooledGroup& each) {
        return each.block == scene.files[tile.file].range.block && sharedTraits(each.traits) == traits &&
               scene.instances[each.places[0]].number == tile.number;
    });
    return group != groups.rend() && group->places.size() < CULL_INSTANCES ? &*group : nullptr;
}

} // namespace

std::vector<PooledGroup> makePooledGroups(const DeviceScene& scene) {
    std::vector<PooledGroup> groups;
    for (const Instance& each : scene.instances) {
        if (!isPooled(scene, each)) continue;
        const InstanceTraits traits = traitsOf(scene, each);
        PooledGroup* group = groupFor(scene, each, groups);
        if (!group) group = &groups.emplace_back(PooledGroup{scene.files[each.file].range.block, {}, traits});
        group->places.push_back(each.place);
        group->traits.uneven |= traits.uneven;
        group->traits.has_balls |= traits.has_balls;
    }
    // sets that stream tiles use one size of programs, whatever tiles are loaded
    for (PooledGroup& group : groups)
        group.traits.pooled_tiles = scene.tile_cache_bytes > 0 ? CULL_INSTANCES : cullProgramSize(group.places.size());
    return groups;
}

std::vector<std::size_t> placesApart(const DeviceScene& scene, const std::vector<PooledGroup>& groups) {
    std::vector<bool> pooled(scene.instances.size());
    for (const PooledGroup& group : groups)
        for (const std::size_t place : group.places) pooled[place] = true;
    std::vector<std::size_t> places;
    for (std::size_t place = 0; place < pooled.size(); ++place)
        if (!pooled[place]) places.push_back(place);
    return places;
}

std::vector<gpu::PooledTile> pooledTiles(const DeviceScene& scene, const PooledGroup& group) {
    std::vector<gpu::PooledTile> tiles;
    for (const std::size_t place : group.places) {
        const Instance& instance = scene.instances[place];
        gpu::PooledTile& tile = tiles.emplace_back();
        tile.instance = instance.params;
        setSectionStarts(scene.files[instance.file], tile);
    }
    return tiles;
}

} // namespace pointrt
