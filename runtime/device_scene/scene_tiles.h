// SPDX-License-Identifier: Apache-2.0
// What stands in a scene, on the device: files, and of sets the tiles that a picture is traced with.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <unordered_set>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// What tiles are chosen for.
struct TileRequest {
    std::vector<Camera> cameras; ///< of the scene, at least one
    PixelSize size;              ///< of their pictures
    std::uint64_t memory = 0;    ///< bytes that the tiles of all sets may take, in files and on the device
    double detail = 1;           ///< CutRequest::detail
    bool painted = false;        ///< splats are painted: they are held once more
    bool tells_coarse = true;    ///< where memory makes a cut coarser
    bool verbose = false;
};

/// What it takes to choose and load tiles, apart from the scene: for other threads.
struct TileOrder {
    std::vector<OpenedSet> sets;              ///< the scene's, in its order
    std::vector<CutRequest> requests;         ///< for each of them
    std::unordered_set<std::string> resident; ///< paths of files that are on the device
    bool on_all_cores = true;                 ///< else on the caller's, and where an index is built on half of them
    /// After so many seconds no tile is begun but the first: whoever asked may want others by then.
    double seconds = std::numeric_limits<double>::infinity();
    bool verbose = false;
};
TileOrder orderTiles(const DeviceScene& scene, const TileRequest& request);

/// Chooses order's cuts anew, with a share of the memory, and returns how many bytes of them are not on the device.
std::uint64_t chooseTiles(TileOrder& order, double share = 1);

/// Tiles for the sets of a scene, on their way there.
struct TileDelivery {
    std::vector<OpenedSet> sets;   ///< the scene's, in its order, with other cuts
    std::vector<DeviceScan> files; ///< what was not on the device yet
    std::vector<std::string> lost; ///< of each tile that could not be opened, why
    bool whole = true;             ///< else time ran out: the cuts cannot stand yet
};
/// Loads what of order's cuts, which were chosen, is not on the device; where a tile cannot be opened, its parent is
/// loaded in its place, and stands for it from then on. Throws Error kBadInput where a root is lost, kCannotRun as
/// loadScan does.
TileDelivery loadTiles(Device& device, TileOrder order);
void destroyTiles(Device& device, TileDelivery& tiles);

/// Puts tiles into scene in place of those that stand for its sets, and makes its instances anew; its tables, and
/// tracers of it, have to be made anew then, too. False where they are the tiles that there were, and nothing is done,
/// and where the delivery is not whole: then its files are there for the next one.
bool standTiles(Device& device, DeviceScene& scene, TileDelivery tiles);
/// All of that, on this thread. A tile that is lost is told of on standard error, once; so is a cut that memory made
/// coarser.
bool standTiles(Device& device, DeviceScene& scene, const TileRequest& request);

/// Makes scene.instances of the files and tiles that are on the device, as its description and its sets' cuts say.
void standInstances(Device& device, DeviceScene& scene);

/// A file as it stands in space, for the programs, but for its materials. number: of its instance
gpu::InstanceParams placeInstance(const RenderSpace& space, const DeviceScan& file, const Placement& placement,
                                  std::uint32_t number);
/// Of a tile: its hits count in this box, in the set's coordinates.
void placeCore(const DeviceScan& file, const TileBox& box, gpu::InstanceParams& params);

/// request, or less where the device has memory of its own, and less of that. Where it has not, request is of the whole
/// process: `others`, the bytes of all else, come off it, though tiles get half of it at least.
std::uint64_t tileMemory(const Device& device, std::uint64_t request, std::uint64_t others = 0);

} // namespace pointrt
