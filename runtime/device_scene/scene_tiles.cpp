// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/scene_tiles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/base/printable.h"
#include "format/set/open_tile.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/device_scene/core_reach.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/gpu/memory_budget.h"
#include "runtime/scene/kept.h"
#include "runtime/util/memory_text.h"
#include "runtime/util/on_error.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

/// Share of the device's own memory for tiles. The rest is left to films, programs and other processes.
constexpr double kDeviceShare = 0.75;

/// Bounds of the rounding error of a tile's hits: some position steps of its cube, plus the error of the translation in
/// its matrix, which is large if the tile is small compared with render space.
constexpr float kCoreSteps = 4, kMatrixRounding = 4e-7f; // a few times 2^-24

/// Self-intersection distance of merged discs, as a share of the distance of original discs. It must be shorter:
/// merging averages out registration errors, so merged discs deviate from the surface only because it is curved within
/// a cell. At the full distance, roofs a few radii above the ground would cast no shadow on coarser levels
/// (tests/bench/NOTES.md, Silhouettes).
constexpr float kMergedSelfShare = 0.5f;

/// Whether tiles are copied into the device's texel pool, where one program traces many of them. GPUs gain time: a
/// dispatch for each tile and list takes longer than tracing its few rays. CPUs read the pages of the mapped files in
/// place.
bool poolsTiles(const Device& device) { return device.type != VK_PHYSICAL_DEVICE_TYPE_CPU; }

/// Bytes per splat of an index that has yet to be built, typical of surfaces (lidar scans take 30 to 127, mostly 35 to
/// 55). It is a constant, not measured from the resident tiles: the same command must choose the same tiles.
constexpr std::uint32_t kBuiltIndexBytes = 82;

/// Bytes per Gaussian on the device in addition to its file: rows, and the lists of the finer tree (kTracedFineness).
constexpr std::uint32_t kGaussianBytes = 190;
/// Copies of near splats that filters make per splat: a splat is in 2.9 lists on average, its own and 1.9 by reference.
constexpr std::uint32_t kShownNearBytes = 3 * PRO_NEAR_WORDS * sizeof(std::uint32_t);

std::unordered_map<std::string, std::uint32_t> slotsByPath(const ResidentFiles& files) {
    std::unordered_map<std::string, std::uint32_t> slots;
    for (const std::uint32_t slot : files.slots()) slots.emplace(files[slot].path, slot);
    return slots;
}

/// Appends instances to a scene.
class InstanceBuilder {
public:
    InstanceBuilder(Device& device, DeviceScene& scene)
        : device_(device), scene_(scene), slots_(slotsByPath(scene.files)) {}

    void addFile(std::uint32_t number, const std::string& path) {
        add(number, slots_.at(path));
        scene_.splat_count += scene_.files[scene_.instances.back().file].info.splat_count;
    }

    void addTiles(const SceneSet& set) {
        const TileSet& tiles = set.opened.set;
        std::vector<bool> in_cut(tiles.tiles.size(), false);
        for (const std::uint32_t tile : set.opened.cut.tiles) in_cut[tile] = true;
        for (const std::uint32_t tile : set.opened.cut.tiles) {
            add(set.number, slots_.at(tilePath(set.opened, tile)));
            Instance& instance = scene_.instances.back();
            instance.tile = tile;
            instance.params.grid_origin.w = tile + 1;
            setCoreBox(scene_.files[instance.file], hitBox(tiles, in_cut, tile), instance.params);
            if (!tiles.tiles[tile].isOriginal()) instance.params.core_high.w = kMergedSelfShare;
            scene_.splat_count += tiles.tiles[tile].splats;
        }
    }

private:
    void add(std::uint32_t number, std::uint32_t file) {
        Instance instance;
        instance.file = file;
        instance.number = number;
        instance.place = scene_.instances.size();
        instance.oriented = (scene_.files[file].info.flags & PRO_FLAG_ORIENTED) != 0;
        instance.params = makeInstanceParams(scene_.space, scene_.files[file],
                                             scene_.description.instances[number].placement, number);
        instance.params.grid_size.w = static_cast<std::uint32_t>(instance.place);
        instance.params_buffer =
            createBuffer(device_, "instance parameters", sizeof instance.params, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        scene_.instances.push_back(instance);
    }

    Device& device_;
    DeviceScene& scene_;
    std::unordered_map<std::string, std::uint32_t> slots_;
};

/// Paths of the tiles in the cuts of the scene's sets and in those of the sets that will replace them.
std::unordered_set<std::string> tilesInUse(const DeviceScene& scene, const std::vector<OpenedSet>& coming) {
    std::unordered_set<std::string> used;
    const auto use = [&](const OpenedSet& set) {
        for (const std::uint32_t tile : set.cut.tiles) used.insert(tilePath(set, tile));
    };
    for (const SceneSet& set : scene.sets) use(set.opened);
    for (const OpenedSet& set : coming) use(set);
    return used;
}

void evict(Device& device, DeviceScene& scene, std::uint32_t slot) {
    DeviceScan file = scene.files.remove(slot);
    scene.device_bytes -= file.device_bytes;
    destroyScan(device, file);
}

/// Evicts tiles that no cut uses, least recently used first, until the files fit in the cache limit.
void evictUnused(Device& device, DeviceScene& scene, const std::vector<OpenedSet>& coming) {
    const std::unordered_set<std::string> used = tilesInUse(scene, coming);
    std::unordered_set<std::uint32_t> unused;
    for (const std::uint32_t slot : scene.files.slots())
        if (used.count(scene.files[slot].path) != 0)
            scene.files.use(slot);
        else
            unused.insert(slot);
    const auto isUnused = [&](std::uint32_t slot) { return unused.count(slot) != 0; };
    while (scene.files.bytes() > scene.tile_cache_bytes) {
        const auto oldest = scene.files.leastRecentlyUsed(isUnused);
        if (!oldest) return;
        evict(device, scene, *oldest);
    }
}

void reportMissing(const std::string& reason) {
    std::fprintf(stderr, "pointrt-view: %s; showing a coarser tile instead\n",
                 printable(reason, std::string::npos).c_str());
}

/// An opened tile, or why it could not be opened.
struct TileFile {
    std::uint32_t tile = 0;
    DeviceScan scan;
    std::exception_ptr failure;
};

void openTile(const OpenedSet& set, TileFile& file) {
    try {
        requireTile(set.set, set.set.tiles[file.tile], set.folder);
        const std::string path = tilePath(set, file.tile);
        file.scan = mapTracedScan(path);
        // set.json says what the tiles contain, and programs and buffers are chosen accordingly
        if (file.scan.is_gaussian != set.set.gaussians)
            throw Error(ExitCode::kBadInput,
                        path + ": belongs to another set (the tile or the set holds Gaussians, but not both)");
    } catch (...) {
        file.failure = std::current_exception();
    }
}

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

std::size_t halfOfCores() { return std::max(std::thread::hardware_concurrency() / 2, 1u); }

class TileLoader {
public:
    TileLoader(Device& device, TileLoadRequest request, LoadedTiles& loaded)
        : device_(device), request_(std::move(request)), loaded_(loaded) {}

    void load() {
        for (std::size_t i = 0; i < request_.sets.size(); ++i)
            while (!loadCut(request_.sets[i])) chooseCuts(request_.sets[i], request_.requests[i]);
        loaded_.sets = std::move(request_.sets);
    }

private:
    /// Loads the tiles of the cut that are not resident, within the time limit. False if one is missing.
    bool loadCut(OpenedSet& set) {
        std::vector<TileFile> tiles;
        for (const std::uint32_t tile : set.cut.tiles)
            if (request_.resident.count(tilePath(set, tile)) == 0) tiles.push_back({tile, {}, {}});
        const auto close = [&] {
            for (TileFile& file : tiles) destroyScan(device_, file.scan);
        };
        const OnError undo(close);
        // in parallel if allowed, since opening a file reads and checks all of it
        if (request_.on_all_cores) forAll(tiles.size(), [&](std::size_t i) { openTile(set, tiles[i]); });
        bool found = true;
        for (TileFile& file : tiles) {
            if (!loaded_.files.empty() && secondsSince(begun_) > request_.time_limit_s) {
                loaded_.complete = false;
                close();
                return true;
            }
            if (!request_.on_all_cores) openTile(set, file);
            found &= upload(set, file);
        }
        return found;
    }

    /// False if the tile cannot be opened; it is then marked as missing. Throws for a root, which has no parent to
    /// replace it.
    bool upload(OpenedSet& set, TileFile& file) {
        try {
            if (file.failure) std::rethrow_exception(file.failure);
            uploadScan(device_, file.scan,
                       {request_.on_all_cores ? 0 : halfOfCores(), request_.verbose, poolsTiles(device_)});
            loaded_.files.push_back(std::exchange(file.scan, {}));
            request_.resident.insert(loaded_.files.back().path);
            return true;
        } catch (const Error& error) {
            destroyScan(device_, file.scan);
            if (error.code != ExitCode::kBadInput || file.tile == 0) throw;
            loaded_.missing.emplace_back(error.what());
            set.missing[file.tile] = true;
            return false;
        }
    }

    Device& device_;
    TileLoadRequest request_;
    LoadedTiles& loaded_;
    Clock::time_point begun_ = Clock::now();
};

/// The half-spaces that clips keep of a set, in the set's coordinates; none for Gaussians, which extend far beyond
/// their tiles.
std::vector<HalfSpace> keptOfSet(const DeviceScene& scene, const SceneSet& set) {
    const InstanceDescription& instance = scene.description.instances[set.number];
    const Placement& placement = instance.placement;
    std::vector<HalfSpace> kept;
    if (set.opened.set.gaussians) return kept;
    for (const HalfSpace& each : keptOf(scene.description.clips, instance))
        kept.push_back({unplaced(placement, each.point), unrotated(placement, each.normal)});
    return kept;
}

CutRequest cutRequest(const DeviceScene& scene, const SceneSet& set, const TileRequest& request) {
    CutRequest cut;
    const Placement& placement = scene.description.instances[set.number].placement;
    for (const Camera& camera : request.cameras) cut.views.push_back(cutView(placement, camera, request.size));
    cut.kept = keptOfSet(scene, set);
    cut.detail = request.detail;
    cut.memory = request.memory / scene.sets.size();
    cut.splat_bytes = request.painted ? PRO_SPLAT_WORDS * sizeof(std::uint32_t) : 0;
    if (hidesSplats(scene.description.filters)) cut.splat_bytes += kShownNearBytes;
    pro_index index; // all tiles of a bake are alike
    if (set.opened.set.gaussians)
        cut.splat_bytes += kGaussianBytes;
    else if (pro_get_index(set.root.file, &index) == 0)
        cut.splat_bytes += kBuiltIndexBytes;
    return cut;
}

void reportCoarse(SceneSet& set, double detail, std::uint64_t memory) {
    const OpenedSet& opened = set.opened;
    if (opened.cut.fits || std::exchange(set.reported_coarse, true)) return;
    const SizeAndLimit shown = sizeAndLimit(opened.full_cut.bytes, memory, mebibytes);
    std::fprintf(stderr,
                 "pointrt-view: %s: coarser than --detail %s: %zu tiles fit in %s, full detail needs %zu tiles (%s); "
                 "raise --memory\n",
                 printable(opened.folder).c_str(), plainText(detail).c_str(), opened.cut.tiles.size(),
                 shown.limit.c_str(), opened.full_cut.tiles.size(), shown.size.c_str());
}

} // namespace

pro_info tracedFrame(const DeviceScan& file) {
    pro_info frame = file.info;
    for (std::size_t i = 0; i < 3; ++i) frame.origin[i] += file.traced_cube.low[i] * frame.scale;
    frame.scale *= file.traced_cube.edge;
    return frame;
}

gpu::InstanceParams makeInstanceParams(const RenderSpace& space, const DeviceScan& file, const Placement& placement,
                                       std::uint32_t number) {
    const std::array<gpu::vec4, 3> rows = cubeFromRender(space, placement, tracedFrame(file));
    const pro_index& grid = file.index;
    const float cells = std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - grid.shift));
    gpu::InstanceParams params{};
    params.row_x = rows[0];
    params.row_y = rows[1];
    params.row_z = rows[2];
    params.splat = {file.info.radius_max, file.info.radius_step, file.info.blend_slab,
                    std::sqrt(rows[0].x * rows[0].x + rows[0].y * rows[0].y + rows[0].z * rows[0].z)};
    params.grid_scale = {cells, cells * PRO_POSITION_STEP, 0, 0};
    params.grid_origin = {grid.origin[0], grid.origin[1], grid.origin[2], 0};
    const std::uint32_t layer = grid.size[0] * grid.size[1];
    params.grid_size = {grid.size[0], grid.size[1], grid.size[2], 0};
    params.grid_words = {layer, layer * grid.size[2] - 1, grid.brick_count * PRO_BRICK_WORDS - 1, 0};
    params.materials = {number, 0, 0, 0};
    if (file.is_gaussian) { // a grid of one cell
        params.grid_scale = {1, PRO_POSITION_STEP, 0, 0};
        params.grid_size = {1, 1, 1, 0};
    }
    params.core_high = {static_cast<float>(grid.size[0]), static_cast<float>(grid.size[1]),
                        static_cast<float>(grid.size[2]), 1};
    params.harmonics = {file.harmonics_max[0], file.harmonics_max[1], file.harmonics_max[2], 0};
    return params;
}

void setCoreBox(const DeviceScan& file, const TileBox& box, gpu::InstanceParams& params) {
    const double cells = params.grid_scale.x;
    const auto along = [&](double input, std::size_t axis) {
        const double cube = (input - file.info.origin[axis]) / file.info.scale;
        return static_cast<float>(cube * cells - file.index.origin[axis]);
    };
    const float moved = std::max({std::abs(params.row_x.w), std::abs(params.row_y.w), std::abs(params.row_z.w)});
    const float margin = (kCoreSteps * PRO_POSITION_STEP + kMatrixRounding * moved) * params.grid_scale.x;
    params.core_low = {along(box.low[0], 0), along(box.low[1], 1), along(box.low[2], 2), margin};
    params.core_high = {along(box.high[0], 0), along(box.high[1], 1), along(box.high[2], 2), params.core_high.w};
}

std::uint64_t tileMemory(const Device& device, std::uint64_t request, std::uint64_t others) {
    if (device.unified_memory) return request - std::min(others, request / 2);
    const auto own = static_cast<double>(availableDeviceMemory(device));
    return std::min(request, static_cast<std::uint64_t>(kDeviceShare * own));
}

void rebuildInstances(Device& device, DeviceScene& scene) {
    for (Instance& instance : scene.instances) destroyBuffer(device, instance.params_buffer);
    scene.instances.clear();
    scene.splat_count = 0;
    InstanceBuilder builder(device, scene);
    auto set = scene.sets.begin();
    for (std::uint32_t i = 0; i < scene.description.instances.size(); ++i)
        if (set != scene.sets.end() && set->number == i)
            builder.addTiles(*set++);
        else
            builder.addFile(i, scene.description.instances[i].path);
}

TileLoadRequest makeTileLoadRequest(const DeviceScene& scene, const TileRequest& request) {
    TileLoadRequest load;
    load.verbose = request.verbose;
    for (const SceneSet& set : scene.sets) {
        load.sets.push_back(set.opened);
        load.requests.push_back(cutRequest(scene, set, request));
    }
    for (const DeviceScan& file : scene.files) load.resident.insert(file.path);
    return load;
}

std::uint64_t chooseTiles(TileLoadRequest& request, double share) {
    std::uint64_t missing = 0;
    for (std::size_t i = 0; i < request.sets.size(); ++i) {
        OpenedSet& set = request.sets[i];
        CutRequest cut = request.requests[i];
        cut.memory = static_cast<std::uint64_t>(share * static_cast<double>(cut.memory));
        chooseCuts(set, cut);
        for (const std::uint32_t tile : set.cut.tiles)
            if (request.resident.count(tilePath(set, tile)) == 0) missing += bytesInCut(set.set.tiles[tile], cut);
    }
    return missing;
}

LoadedTiles loadTiles(Device& device, TileLoadRequest request) {
    LoadedTiles loaded;
    const OnError undo([&] { destroyTiles(device, loaded); });
    TileLoader(device, std::move(request), loaded).load();
    return loaded;
}

void destroyTiles(Device& device, LoadedTiles& tiles) {
    for (DeviceScan& file : tiles.files) destroyScan(device, file);
    tiles = {};
}

bool applyTiles(Device& device, DeviceScene& scene, LoadedTiles tiles) {
    for (DeviceScan& file : tiles.files) {
        const std::uint64_t bytes = file.device_bytes;
        scene.device_bytes += bytes;
        scene.files.add(std::move(file), bytes, Eviction::kAllowed);
    }
    if (!tiles.complete) {
        for (std::size_t i = 0; i < scene.sets.size(); ++i) scene.sets[i].opened.missing = tiles.sets[i].missing;
        evictUnused(device, scene, tiles.sets);
        return false;
    }
    bool changed = scene.instances.empty();
    for (std::size_t i = 0; i < scene.sets.size(); ++i) {
        changed |= scene.sets[i].opened.cut.tiles != tiles.sets[i].cut.tiles;
        scene.sets[i].opened = std::move(tiles.sets[i]);
    }
    evictUnused(device, scene, {});
    if (!changed) return false;
    scene.device_bytes -= deviceBytes(scene.paint);
    destroyScenePaint(device, scene.paint);
    rebuildInstances(device, scene);
    return true;
}

bool updateTiles(Device& device, DeviceScene& scene, const TileRequest& request) {
    TileLoadRequest load = makeTileLoadRequest(scene, request);
    chooseTiles(load);
    LoadedTiles tiles = loadTiles(device, std::move(load));
    for (const std::string& reason : tiles.missing) reportMissing(reason);
    const bool changed = applyTiles(device, scene, std::move(tiles));
    for (SceneSet& set : scene.sets)
        if (request.reports_coarse) reportCoarse(set, request.detail, request.memory / scene.sets.size());
    return changed;
}

} // namespace pointrt
