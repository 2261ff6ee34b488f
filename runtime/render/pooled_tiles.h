// SPDX-License-Identifier: Apache-2.0
// Tiles of a set that lie in one block of the device's texel pool. One program traces all of them, so that the number
// of dispatches hardly depends on the number of tiles.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/instance_traits.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Tiles that programs trace together.
struct PooledGroup {
    const TexelBlock* block = nullptr;
    std::vector<std::size_t> places; ///< among the scene's instances, ascending; at most CULL_INSTANCES
    InstanceTraits traits;           ///< of the programs, which suit all of the tiles
};

/// Groups of all tiles that may be traced together. Painted tiles may not: their splats are in separate buffers.
std::vector<PooledGroup> makePooledGroups(const DeviceScene& scene);

/// Places of the instances that are in no group.
std::vector<std::size_t> placesApart(const DeviceScene& scene, const std::vector<PooledGroup>& groups);

/// The rows of a group's tiles for its programs.
std::vector<gpu::PooledTile> pooledTiles(const DeviceScene& scene, const PooledGroup& group);

} // namespace pointrt
