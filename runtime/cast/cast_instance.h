// SPDX-License-Identifier: Apache-2.0
// The instances that rays are traced against, one at a time: placed .pro files, and the original tiles of placed tile
// sets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The tile number of an instance that is not a tile.
constexpr std::uint32_t kNoTile = 0xFFFFFFFFu;

struct CastInstance {
    std::uint32_t file = 0;           ///< in InstanceList::files
    std::uint32_t scene_instance = 0; ///< its number in the scene: the tiles of a set share one
    std::uint32_t tile = kNoTile;     ///< number in its set
    Placement placement;
    std::optional<TileBox> core; ///< the box that a tile's hits are clipped to, in the set's coordinates
    Bounds box;                  ///< around everything that can be hit, world units
};

struct InstanceSet {
    std::string folder;
    TileSet set;
    std::vector<std::uint32_t> tiles; ///< its original tiles, ascending
    std::vector<TileBox> cores;       ///< the box that each tile's hits are clipped to
    std::vector<TileBox> boxes;       ///< a box around each tile's discs within its core, perhaps much smaller
};

/// A .pro file; has one entry, however many instances it has.
struct InstanceFile {
    std::string path;
    std::uint32_t set = 0; ///< for a tile: its set, in InstanceList::sets
    std::uint32_t tile = kNoTile;
    std::uint64_t bytes = 0;              ///< for a tile: its size according to its set
    std::vector<std::uint32_t> instances; ///< in InstanceList::instances
};

/// The consecutive CastInstances of one instance of the scene: a single one, or for a set one per tile, in the order of
/// its tiles.
struct InstanceRun {
    std::uint32_t first = 0, count = 0;
    std::optional<std::uint32_t> set; ///< in InstanceList::sets
    std::vector<HalfSpace> kept;      ///< half-spaces that clips keep; empty: not clipped
    std::vector<FilterDescription> filters;
    std::optional<Vec3> up; ///< up direction for heights; none: the scan's
};

struct InstanceList {
    std::vector<CastInstance> instances;
    std::vector<InstanceFile> files;
    std::vector<InstanceSet> sets;
    std::vector<InstanceRun> scene_instances;
    std::vector<ShapeDescription> shapes; ///< from scene files
};

/// Finds a scene instance or, if the instance is a tile set, one of its tiles. Returns its index in list.instances, or
/// nullopt if the list does not contain it.
std::optional<std::uint32_t> findInstance(const InstanceList& list, std::uint32_t scene_instance, std::uint32_t tile);

} // namespace pointrt
