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
#include "runtime/device_scene/core_reach.h"
#include "runtime/util/on_error.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

/// Of the device's own memory: what films, programs and others need is left.
constexpr double kDeviceShare = 0.75;

/// What of a tile's place rounding makes, of its cube: hits and cores are told to a position step, and where the tile
/// is small beside render space, its matrix moves all by a share of that.
constexpr float kCoreSteps = 4, kMatrixRounding = 4e-7f; // a few times 2^-24

/// Merged discs are means of what scans' registration left beside each other, and stand off only by the curvature of
/// their cells: of the radii up to which hits are on the surface that a ray leaves half do. Else roofs a few radii over
/// the ground cast no shadow on coarser levels (tests/bench/NOTES.md, Outlines).
constexpr float kMergedOwnShare = 0.5f;

/// Of tiles without an index, a splat's share of it once it is built, as of most surfaces; lidar has 30 to 127, mostly
/// 35 to 55. It may not depend on what is there already: the same command chooses the same tiles.
constexpr std::uint32_t kBuiltIndexBytes = 82;

std::unordered_map<std::string, std::uint32_t> filesByPath(const DeviceScene& scene) {
    std::unordered_map<std::string, std::uint32_t> files;
    for (std::uint32_t i = 0; i < scene.files.size(); ++i) files.emplace(scene.files[i].path, i);
    return files;
}

/// Instances on their way into a scene.
class Standing {
public:
    Standing(Device& device, DeviceScene& scene) : device_(device), scene_(scene), files_(filesByPath(scene)) {}

    void addFile(std::uint32_t number, const std::string& path) {
        add(number, files_.at(path));
        scene_.splat_count += scene_.files[scene_.instances.back().file].info.splat_count;
    }

    void addTiles(const SceneSet& set) {
        const TileSet& tiles = set.opened.set;
        std::vector<bool> in_cut(tiles.tiles.size(), false);
        for (const std::uint32_t tile : set.opened.cut.tiles) in_cut[tile] = true;
        for (const std::uint32_t tile : set.opened.cut.tiles) {
            add(set.number, files_.at(tilePath(set.opened, tile)));
            Instance& instance = scene_.instances.back();
            instance.tile = tile;
            instance.params.grid_origin.w = tile + 1;
            placeCore(scene_.files[instance.file], hitBox(tiles, in_cut, tile), instance.params);
            if (!tiles.tiles[tile].isOriginal()) instance.params.core_high.w = kMergedOwnShare;
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
        instance.params =
            placeInstance(scene_.space, scene_.files[file], scene_.description.instances[number].placement, number);
        instance.params_buffer =
            createBuffer(device_, "instance parameters", sizeof instance.params, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        scene_.instances.push_back(instance);
    }

    Device& device_;
    DeviceScene& scene_;
    std::unordered_map<std::string, std::uint32_t> files_;
};

/// Paths of the files that instances and cuts name, those of sets that are to come as well.
std::unordered_set<std::string> usedFiles(const DeviceScene& scene, const std::vector<OpenedSet>& coming) {
    std::unordered_set<std::string> used;
    for (const InstanceDescription& each : scene.description.instances) used.insert(each.path);
    const auto use = [&](const OpenedSet& set) {
        for (const std::uint32_t tile : set.cut.tiles) used.insert(tilePath(set, tile));
    };
    for (const SceneSet& set : scene.sets) use(set.opened);
    for (const OpenedSet& set : coming) use(set);
    return used;
}

/// Lets go what nothing names any more: those first that were used the longest ago, until the others fit in the cache.
void dropUnused(Device& device, DeviceScene& scene, const std::vector<OpenedSet>& coming) {
    const std::unordered_set<std::string> used = usedFiles(scene, coming);
    ++scene.tile_uses;
    std::uint64_t bytes = 0;
    std::vector<std::uint64_t> unused; ///< when they were used last
    for (DeviceScan& file : scene.files) {
        bytes += file.device_bytes;
        if (used.count(file.path) != 0)
            file.last_used = scene.tile_uses;
        else
            unused.push_back(file.last_used);
    }
    std::sort(unused.begin(), unused.end());
    for (const std::uint64_t oldest : unused) {
        if (bytes <= scene.tile_cache_bytes) break;
        const auto file = std::find_if(scene.files.begin(), scene.files.end(),
                                       [&](const DeviceScan& each) { return each.last_used == oldest; });
        bytes -= file->device_bytes;
        scene.device_bytes -= file->device_bytes;
        destroyScan(device, *file);
        scene.files.erase(file);
    }
}

void tellLost(const std::string& reason) {
    std::fprintf(stderr, "pointrt-view: %s; what a coarser tile has of it is shown\n",
                 printable(reason, std::string::npos).c_str());
}

/// A tile that was opened, or why it was not.
struct TileFile {
    std::uint32_t tile = 0;
    DeviceScan scan;
    std::exception_ptr failure;
};

void openTile(const OpenedSet& set, TileFile& file) {
    try {
        requireTile(set.set, set.set.tiles[file.tile], set.folder);
        file.scan = mapTracedScan(tilePath(set, file.tile));
    } catch (...) {
        file.failure = std::current_exception();
    }
}

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

std::size_t halfOfCores() { return std::max(std::thread::hardware_concurrency() / 2, 1u); }

/// Loads tiles for a delivery.
class TileLoader {
public:
    TileLoader(Device& device, TileOrder order, TileDelivery& delivery)
        : device_(device), order_(std::move(order)), delivery_(delivery) {}

    void load() {
        for (std::size_t i = 0; i < order_.sets.size(); ++i)
            while (!loadCut(order_.sets[i])) chooseCuts(order_.sets[i], order_.requests[i]);
        delivery_.sets = std::move(order_.sets);
    }

private:
    /// What is not there yet, as far as there is time. False where something of it is lost.
    bool loadCut(OpenedSet& set) {
        std::vector<TileFile> missing;
        for (const std::uint32_t tile : set.cut.tiles)
            if (order_.resident.count(tilePath(set, tile)) == 0) missing.push_back({tile, {}, {}});
        const auto close = [&] {
            for (TileFile& file : missing) destroyScan(device_, file.scan);
        };
        const OnError undo(close);
        // they are read from end to end
        if (order_.on_all_cores) forAll(missing.size(), [&](std::size_t i) { openTile(set, missing[i]); });
        bool found = true;
        for (TileFile& file : missing) {
            if (!delivery_.files.empty() && secondsSince(begun_) > order_.seconds) {
                delivery_.whole = false;
                close();
                return true;
            }
            if (!order_.on_all_cores) openTile(set, file);
            found &= take(set, file);
        }
        return found;
    }

    /// True where it was there; else it is marked as lost. A root has no other that would stand for it.
    bool take(OpenedSet& set, TileFile& file) {
        try {
            if (file.failure) std::rethrow_exception(file.failure);
            uploadScan(device_, file.scan, {order_.on_all_cores ? 0 : halfOfCores(), order_.verbose});
            delivery_.files.push_back(std::exchange(file.scan, {}));
            order_.resident.insert(delivery_.files.back().path);
            return true;
        } catch (const Error& error) {
            destroyScan(device_, file.scan);
            if (error.code != ExitCode::kBadInput || file.tile == 0) throw;
            delivery_.lost.emplace_back(error.what());
            set.lost[file.tile] = true;
            return false;
        }
    }

    Device& device_;
    TileOrder order_;
    TileDelivery& delivery_;
    Clock::time_point begun_ = Clock::now();
};

CutRequest cutRequest(const DeviceScene& scene, const SceneSet& set, const TileRequest& request) {
    CutRequest wanted;
    const Placement& placement = scene.description.instances[set.number].placement;
    for (const Camera& camera : request.cameras) wanted.views.push_back(cutView(placement, camera, request.size));
    wanted.detail = request.detail;
    wanted.memory = request.memory / scene.sets.size();
    wanted.splat_bytes = request.painted ? PRO_SPLAT_WORDS * sizeof(std::uint32_t) : 0;
    pro_index index;
    if (pro_get_index(set.root.file, &index) == 0) wanted.splat_bytes += kBuiltIndexBytes; // a bake's tiles are alike
    return wanted;
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

void tellCoarse(SceneSet& set, double detail, std::uint64_t memory) {
    const OpenedSet& opened = set.opened;
    if (opened.cut.fits || std::exchange(set.told_coarse, true)) return;
    std::fprintf(stderr,
                 "pointrt-view: %s: coarser than --detail %s asks for: %zu tiles fit in %s, and it wants %zu with %s; "
                 "--memory gives more\n",
                 printable(opened.folder).c_str(), plainText(detail).c_str(), opened.cut.tiles.size(),
                 mebibytes(memory).c_str(), opened.wanted.tiles.size(), mebibytes(opened.wanted.bytes).c_str());
}

} // namespace

gpu::InstanceParams placeInstance(const RenderSpace& space, const DeviceScan& file, const Placement& placement,
                                  std::uint32_t number) {
    const std::array<gpu::vec4, 3> rows = cubeFromRender(space, placement, file.info);
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
    params.core_high = {static_cast<float>(grid.size[0]), static_cast<float>(grid.size[1]),
                        static_cast<float>(grid.size[2]), 1};
    return params;
}

void placeCore(const DeviceScan& file, const TileBox& box, gpu::InstanceParams& params) {
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
    std::uint64_t own = 0;
    for (std::uint32_t i = 0; i < device.memory.memoryHeapCount; ++i)
        if (device.memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            own = std::max<std::uint64_t>(own, device.memory.memoryHeaps[i].size);
    return std::min(request, static_cast<std::uint64_t>(kDeviceShare * static_cast<double>(own)));
}

void standInstances(Device& device, DeviceScene& scene) {
    for (Instance& instance : scene.instances) destroyBuffer(device, instance.params_buffer);
    scene.instances.clear();
    scene.splat_count = 0;
    Standing standing(device, scene);
    auto set = scene.sets.begin();
    for (std::uint32_t i = 0; i < scene.description.instances.size(); ++i)
        if (set != scene.sets.end() && set->number == i)
            standing.addTiles(*set++);
        else
            standing.addFile(i, scene.description.instances[i].path);
}

TileOrder orderTiles(const DeviceScene& scene, const TileRequest& request) {
    TileOrder order;
    order.verbose = request.verbose;
    for (const SceneSet& set : scene.sets) {
        order.sets.push_back(set.opened);
        order.requests.push_back(cutRequest(scene, set, request));
    }
    for (const DeviceScan& file : scene.files) order.resident.insert(file.path);
    return order;
}

std::uint64_t chooseTiles(TileOrder& order, double share) {
    std::uint64_t missing = 0;
    for (std::size_t i = 0; i < order.sets.size(); ++i) {
        OpenedSet& set = order.sets[i];
        CutRequest request = order.requests[i];
        request.memory = static_cast<std::uint64_t>(share * static_cast<double>(request.memory));
        chooseCuts(set, request);
        for (const std::uint32_t tile : set.cut.tiles)
            if (order.resident.count(tilePath(set, tile)) == 0) missing += bytesInCut(set.set.tiles[tile], request);
    }
    return missing;
}

TileDelivery loadTiles(Device& device, TileOrder order) {
    TileDelivery delivery;
    const OnError undo([&] { destroyTiles(device, delivery); });
    TileLoader(device, std::move(order), delivery).load();
    return delivery;
}

void destroyTiles(Device& device, TileDelivery& tiles) {
    for (DeviceScan& file : tiles.files) destroyScan(device, file);
    tiles = {};
}

bool standTiles(Device& device, DeviceScene& scene, TileDelivery tiles) {
    for (DeviceScan& file : tiles.files) {
        scene.device_bytes += file.device_bytes;
        scene.files.push_back(std::move(file));
    }
    if (!tiles.whole) {
        for (std::size_t i = 0; i < scene.sets.size(); ++i) scene.sets[i].opened.lost = tiles.sets[i].lost;
        dropUnused(device, scene, tiles.sets);
        return false;
    }
    bool others = scene.instances.empty();
    for (std::size_t i = 0; i < scene.sets.size(); ++i) {
        others |= scene.sets[i].opened.cut.tiles != tiles.sets[i].cut.tiles;
        scene.sets[i].opened = std::move(tiles.sets[i]);
    }
    dropUnused(device, scene, {});
    if (!others) return false;
    scene.device_bytes -= deviceBytes(scene.paint);
    destroyScenePaint(device, scene.paint);
    standInstances(device, scene);
    return true;
}

bool standTiles(Device& device, DeviceScene& scene, const TileRequest& request) {
    TileOrder order = orderTiles(scene, request);
    chooseTiles(order);
    TileDelivery tiles = loadTiles(device, std::move(order));
    for (const std::string& reason : tiles.lost) tellLost(reason);
    const bool others = standTiles(device, scene, std::move(tiles));
    for (SceneSet& set : scene.sets)
        if (request.tells_coarse) tellCoarse(set, request.detail, request.memory / scene.sets.size());
    return others;
}

} // namespace pointrt
