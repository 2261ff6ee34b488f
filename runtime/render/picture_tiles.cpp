// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/picture_tiles.h"

#include <algorithm>

#include "runtime/render/picture_filter.h"
#include "runtime/render/tile_feedback.h"

namespace pointrt {
namespace {

/// Tiles as their rays want them, round by round: what children are met is known when they are there. Two rounds bring
/// what no camera sees to the pixel of what one sees (kUnseenPixel), and one finds that nothing more is wanted.
constexpr int kTileRounds = 3;

/// Of a turntable so many tell which tiles it needs.
constexpr std::uint32_t kTurntableCameras = 64;

/// What a process takes beside tiles and the filter: the driver and its programs up to 190 MB, a band of a film 65,
/// what is in flight with rays in queues another 50, as measured with lavapipe. Whether a picture will be filtered or
/// in queues is not asked, so that its tiles do not depend on that.
constexpr std::uint64_t kProcessBytes = 305'000'000;

/// That tiles are chosen for.
std::vector<Camera> pictureCameras(const LoadedScene& loaded, const LoadRequest& request) {
    if (request.turntable == 0) return {loaded.camera};
    const TurntableAxis axis = turntableAxis(loaded);
    const std::uint32_t count = std::min(request.turntable, kTurntableCameras);
    std::vector<Camera> cameras;
    for (std::uint32_t i = 0; i < count; ++i) cameras.push_back(turntableCamera(loaded.camera, axis, i, count));
    return cameras;
}

void remakeTables(Device& device, LoadedScene& loaded) {
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
    tiles.tells_coarse = !request.roots_alone;
    const std::vector<InstanceDescription>& instances = loaded.scene.description.instances;
    tiles.painted = std::any_of(instances.begin(), instances.end(),
                                [&](const InstanceDescription& each) { return isPainted(each, loaded.settings); });
    tiles.verbose = request.verbose;
    return tiles;
}

void standTilesAnew(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    for (SceneSet& each : loaded.scene.sets)
        std::fill_n(each.opened.wanted_unseen.begin(), each.opened.set.tiles.size(), false);
    if (standTiles(device, loaded.scene, tileRequest(device, loaded, request))) remakeTables(device, loaded);
    refineTiles(device, loaded, request);
}

void refineTiles(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    const TileRequest tiles = tileRequest(device, loaded, request);
    for (int round = 0; round < kTileRounds; ++round) {
        if (!markTilesMet(device, loaded.tracer, loaded.scene, loaded.settings, tiles.cameras)) return;
        if (!standTiles(device, loaded.scene, tiles)) return;
        remakeTables(device, loaded);
    }
}

} // namespace pointrt
