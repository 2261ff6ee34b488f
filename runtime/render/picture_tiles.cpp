// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/picture_tiles.h"

#include <algorithm>

#include "runtime/render/picture_filter.h"
#include "runtime/render/tile_feedback.h"

namespace pointrt {
namespace {

/// Rounds of refinement by secondary rays: which children are hit is known only once they are loaded. Two rounds refine
/// tiles outside the views to their pixel size (kUnseenPixelScale); the third finds nothing left to refine.
constexpr int kTileRounds = 3;

/// Limit for the positions of a moving camera for which tiles are selected.
constexpr std::uint32_t kTurntableCameras = 64;

/// Memory of a process in addition to tiles and the filter, measured with lavapipe: the driver and its programs up to
/// 190 MB, a band of a film 65 MB, wavefront queues 50 MB. Counted whether or not a picture is filtered or uses queues,
/// so that its tiles do not depend on that.
constexpr std::uint64_t kProcessBytes = 305'000'000;

/// The cameras to select tiles for.
std::vector<Camera> pictureCameras(const LoadedScene& loaded, const LoadRequest& request) {
    if (request.turntable == 0) return {loaded.camera};
    const std::uint32_t count = std::min(request.turntable, kTurntableCameras);
    std::vector<Camera> cameras;
    for (std::uint32_t i = 0; i < count; ++i)
        cameras.push_back(movingCamera(loaded, loaded.camera, request.follows_views, i, count));
    return cameras;
}

void rebuildTables(Device& device, LoadedScene& loaded) {
    uploadSceneTables(device, loaded.scene, loaded.settings);
    addPrograms(device, loaded.scene, loaded.settings, loaded.tracer.programs);
    rebind(device, loaded.tracer);
}

} // namespace

std::uint64_t pictureTileMemory(const Device& device, const RenderSettings& settings, std::uint64_t memory) {
    const PixelSize size{settings.width, settings.height};
    return tileMemory(device, memory, kProcessBytes + filterBytes({.picture = size, .tile = filterTileFor(size)}));
}

TileRequest tileRequest(const Device& device, const LoadedScene& loaded, const LoadRequest& request) {
    TileRequest tiles;
    tiles.cameras = pictureCameras(loaded, request);
    tiles.size = {loaded.settings.width, loaded.settings.height};
    tiles.detail = loaded.settings.detail;
    tiles.memory = request.roots_alone ? 0 : pictureTileMemory(device, loaded.settings, request.memory);
    tiles.reports_coarse = !request.roots_alone;
    tiles.painted = paintsScans(loaded.scene.description, loaded.settings);
    tiles.verbose = request.verbose;
    return tiles;
}

void reselectTiles(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    for (SceneSet& each : loaded.scene.sets)
        std::fill_n(each.opened.hit_unseen.begin(), each.opened.set.tiles.size(), false);
    if (updateTiles(device, loaded.scene, tileRequest(device, loaded, request))) rebuildTables(device, loaded);
    refineTiles(device, loaded, request);
}

void refineTiles(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    const TileRequest tiles = tileRequest(device, loaded, request);
    for (int round = 0; round < kTileRounds; ++round) {
        if (!markTilesHit(device, loaded.tracer, loaded.scene, loaded.settings, tiles.cameras)) return;
        if (!updateTiles(device, loaded.scene, tiles)) return;
        rebuildTables(device, loaded);
    }
}

} // namespace pointrt
