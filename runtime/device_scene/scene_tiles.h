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

/// The pictures for which tiles are chosen.
struct TileRequest {
    std::vector<Camera> cameras; ///< of the scene, at least one
    PixelSize size;              ///< of their pictures
    std::uint64_t memory = 0;    ///< limit for the tiles of all sets, bytes in files and on the device
    double detail = 1;           ///< CutRequest::detail
    bool painted = false;        ///< whether splats are painted, so that the device holds them twice
    bool reports_coarse = true;  ///< warn if the memory limit makes a cut coarser
    bool verbose = false;
};

/// Everything needed to choose and load tiles, so that another thread can do so without the scene.
struct TileLoadRequest {
    std::vector<OpenedSet> sets;              ///< in the scene's order
    std::vector<CutRequest> requests;         ///< one for each set
    std::unordered_set<std::string> resident; ///< paths of the files on the device
    /// true: load on all cores; false: load on the calling thread, and build indices on half of the cores.
    bool on_all_cores = true;
    /// No further tile is started after this many seconds, except the first: the caller may want other tiles by then.
    double time_limit_s = std::numeric_limits<double>::infinity();
    bool verbose = false;
};
TileLoadRequest makeTileLoadRequest(const DeviceScene& scene, const TileRequest& request);

/// Chooses the cuts of request again, with this share of its memory. Returns the bytes of the chosen tiles that are not
/// resident.
std::uint64_t chooseTiles(TileLoadRequest& request, double share = 1);

/// Tiles on the device that are not part of the scene yet.
struct LoadedTiles {
    std::vector<OpenedSet> sets;      ///< with their new cuts, in the scene's order
    std::vector<DeviceScan> files;    ///< files that were not resident
    std::vector<std::string> missing; ///< for each tile that could not be opened, the reason
    bool complete = true;             ///< false: time ran out before all tiles of the cuts were loaded
};
/// Loads the tiles of the chosen cuts that are not resident. A tile that cannot be opened is marked as missing and its
/// parent is used from then on. Throws Error kBadInput if a root cannot be opened, kCannotRun as loadScan does.
LoadedTiles loadTiles(Device& device, TileLoadRequest request);
void destroyTiles(Device& device, LoadedTiles& tiles);

/// Moves tiles into scene, makes their cuts the current ones, evicts unused files and rebuilds the instances. Returns
/// true if the cuts changed: the caller must then update the scene's tables and rebind its tracers. If tiles are not
/// complete, only keeps their files for the next call.
bool applyTiles(Device& device, DeviceScene& scene, LoadedTiles tiles);
/// Chooses, loads and applies tiles on this thread. Reports missing tiles on standard error, and once per set that the
/// memory limit made its cut coarser. Returns what applyTiles returns.
bool updateTiles(Device& device, DeviceScene& scene, const TileRequest& request);

/// Makes scene.instances from the resident files, the scene's description and the cuts of its sets.
void rebuildInstances(Device& device, DeviceScene& scene);

/// The frame of a file; for Gaussians, with the cube that they are traced in.
pro_info tracedFrame(const DeviceScan& file);
/// The shader parameters of a placed file, except its materials and clips.
/// @param number of the instance in the description
gpu::InstanceParams makeInstanceParams(const RenderSpace& space, const DeviceScan& file, const Placement& placement,
                                       std::uint32_t number);
/// Clips the hits of a tile to box, in the set's coordinates.
void setCoreBox(const DeviceScan& file, const TileBox& box, gpu::InstanceParams& params);

/// The memory limit for tiles, bytes. On a device with dedicated memory, the limit is request, but at most a share of
/// that memory. Otherwise request applies to the whole process: `others`, the bytes of everything else, are subtracted,
/// but no more than half of request.
std::uint64_t tileMemory(const Device& device, std::uint64_t request, std::uint64_t others = 0);

} // namespace pointrt
