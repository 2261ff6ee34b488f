// SPDX-License-Identifier: Apache-2.0
// Tile streaming: chooses the level-of-detail cut of each tile set in a scene, loads its tiles and evicts others.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <unordered_set>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// What to choose tiles for.
struct TileRequest {
    std::vector<Camera> cameras; ///< of the scene, at least one
    PixelSize size;              ///< of their pictures
    std::uint64_t memory = 0;    ///< limit for the tiles of all sets, bytes in files and on the device
    double detail = 1;           ///< CutRequest::detail
    bool painted = false;        ///< splats are painted: the device holds them twice
    bool reports_coarse = true;  ///< warn if the memory limit makes a cut coarser
    bool verbose = false;
};

/// All it takes to choose and load tiles on another thread, independent of the scene.
struct TileLoadRequest {
    std::vector<OpenedSet> sets;              ///< in the scene's order
    std::vector<CutRequest> requests;         ///< one for each set
    std::unordered_set<std::string> resident; ///< paths of the files on the device
    /// Load on all cores. Otherwise on the calling thread, and build indices on half of the cores.
    bool on_all_cores = true;
    /// Seconds after which no further tile is begun, except the first: the caller may want other tiles by then.
    double time_limit_s = std::numeric_limits<double>::infinity();
    bool verbose = false;
};
TileLoadRequest makeTileLoadRequest(const DeviceScene& scene, const TileRequest& request);

/// Chooses the cuts of request again, with a share of its memory. Returns how many bytes of them are not resident.
std::uint64_t chooseTiles(TileLoadRequest& request, double share = 1);

/// Tiles on the device that the scene does not have yet.
struct LoadedTiles {
    std::vector<OpenedSet> sets;      ///< with their new cuts, in the scene's order
    std::vector<DeviceScan> files;    ///< that were not resident
    std::vector<std::string> missing; ///< why a tile could not be opened, for each such tile
    bool complete = true;             ///< false: time ran out before all tiles of the cuts were loaded
};
/// Loads the tiles of the chosen cuts that are not resident. A tile that cannot be opened is marked as missing and its
/// parent is used from then on. Throws Error kBadInput if a root cannot be opened, kCannotRun as loadScan does.
LoadedTiles loadTiles(Device& device, TileLoadRequest request);
void destroyTiles(Device& device, LoadedTiles& tiles);

/// Moves tiles into scene, makes their cuts the current ones, evicts unused files and rebuilds the instances. Returns
/// true if the cuts changed: the caller must then update the scene's tables and rebind its tracers. If tiles are not
/// complete, only their files are kept, for the next call.
bool applyTiles(Device& device, DeviceScene& scene, LoadedTiles tiles);
/// Chooses, loads and applies tiles on this thread. Reports missing tiles, and once per set a cut that the memory limit
/// made coarser, on standard error. Returns as applyTiles.
bool updateTiles(Device& device, DeviceScene& scene, const TileRequest& request);

/// Makes scene.instances from the resident files, the scene's description and the cuts of its sets.
void rebuildInstances(Device& device, DeviceScene& scene);

/// The frame of a file, with the cube that its Gaussians are traced in.
pro_info tracedFrame(const DeviceScan& file);
/// The shader parameters of a placed file, except its materials and clips.
/// @param number of the instance in the description
gpu::InstanceParams makeInstanceParams(const RenderSpace& space, const DeviceScan& file, const Placement& placement,
                                       std::uint32_t number);
/// Clips the hits of a tile to box, in the set's coordinates.
void setCoreBox(const DeviceScan& file, const TileBox& box, gpu::InstanceParams& params);

/// The memory limit for tiles, bytes. On a device with memory of its own: request, but at most a share of that memory.
/// Otherwise request covers the whole process: `others`, the bytes of everything else, are subtracted, but at most half
/// of request.
std::uint64_t tileMemory(const Device& device, std::uint64_t request, std::uint64_t others = 0);

} // namespace pointrt
