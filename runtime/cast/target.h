// SPDX-License-Identifier: Apache-2.0
// What rays are held against, one by one: .pro files, and of tile sets the original tiles, as they stand in the world.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// In place of a tile's number where a target is none.
constexpr std::uint32_t kNoTile = 0xFFFFFFFFu;

struct Target {
    std::uint32_t file = 0;       ///< in TargetList::files
    std::uint32_t instance = 0;   ///< of the scene
    std::uint32_t tile = kNoTile; ///< its number in its set
    Placement placement;
    std::optional<TileBox> core; ///< of a tile: where its hits count, in the set's coordinates
    Bounds box;                  ///< around all that can be hit, world units
};

struct TargetSet {
    std::string folder;
    TileSet set;
    std::vector<std::uint32_t> tiles; ///< its original ones, rising
    std::vector<TileBox> cores;       ///< of each: where its hits count
    std::vector<TileBox> boxes;       ///< of each: where they can lie, which may be much less
};

/// A .pro, however often it stands in the scene.
struct TargetFile {
    std::string path;
    std::uint32_t set = 0; ///< in TargetList::sets, of a tile
    std::uint32_t tile = kNoTile;
    std::uint64_t bytes = 0;            ///< of a tile, by its set
    std::vector<std::uint32_t> targets; ///< where it stands
};

/// The targets of an instance, one behind the other; of a set in the order of its tiles.
struct TargetRun {
    std::uint32_t first = 0, count = 0;
    std::optional<std::uint32_t> set; ///< in TargetList::sets
};

struct TargetList {
    std::vector<Target> targets;
    std::vector<TargetFile> files;
    std::vector<TargetSet> sets;
    std::vector<TargetRun> instances;
    std::vector<ShapeDescription> shapes; ///< of the scene files
};

/// What an instance's hit is of: a number in list.targets. Nothing where there is no such instance or tile; tile is
/// read of sets alone.
std::optional<std::uint32_t> findTarget(const TargetList& list, std::uint32_t instance, std::uint32_t tile);

} // namespace pointrt
