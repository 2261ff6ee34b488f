// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/resident_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/set/open_tile.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/util/available_memory.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// Allocations of a tile on the device: its sections', its grid's, noise and parameters, and some for pages.
constexpr std::size_t kAllocationsOfATile = 16;

/// A share of a file's size, more than what rounding adds where rays are asked whether they come to it.
constexpr double kFileMargin = 1e-4;

/// Around all discs of a file, in the world: its entry grid.
Bounds boxOf(const DeviceScan& scan, const Placement& placement) {
    pro_info grid = scan.info;
    const double cell = scan.info.scale * std::ldexp(1.0, static_cast<int>(scan.index.shift) - PRO_POSITION_BITS);
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.bounds_min[axis] = scan.info.origin[axis] + cell * scan.index.origin[axis];
        grid.bounds_max[axis] = grid.bounds_min[axis] + cell * scan.index.size[axis];
        longest = std::max(longest, cell * scan.index.size[axis]);
    }
    for (double& low : grid.bounds_min) low -= kFileMargin * longest;
    for (double& high : grid.bounds_max) high += kFileMargin * longest;
    return placedBounds(placement, grid);
}

/// Whether its rows change nothing.
bool isUnit(const gpu::InstanceParams& params) {
    const auto is = [](const gpu::vec4& row, float x, float y, float z) {
        return row.x == x && row.y == y && row.z == z && row.w == 0;
    };
    return is(params.row_x, 1, 0, 0) && is(params.row_y, 0, 1, 0) && is(params.row_z, 0, 0, 1);
}

/// Around the cube of a target's file.
RenderSpace spaceOf(const Target& target, const DeviceScan& scan) {
    SceneDescription alone;
    alone.instances.push_back({scan.path, target.placement, {}, {}});
    return chooseRenderSpace(alone, {&scan.info, 1});
}

} // namespace

std::uint64_t splatCount(const ResidentTargets& resident) {
    std::uint64_t count = 0;
    for (const TargetRun& instance : resident.list().instances)
        count += instance.set ? resident.list().sets[*instance.set].set.splats
                              : resident.find(instance.first)->scan->info.splat_count;
    return count;
}

ResidentTargets::ResidentTargets(Device& device, TargetList list, std::uint64_t memory)
    : device_(device), list_(std::move(list)), memory_(tileMemory(device, memory)),
      most_tiles_(std::max<std::size_t>(1, device.limits.maxMemoryAllocationCount / kAllocationsOfATile)),
      files_(list_.files.size()), placed_(list_.targets.size()) {
    const OnError undo([&] { destroy(); });
    open();
}

ResidentTargets::~ResidentTargets() { destroy(); }

void ResidentTargets::destroy() {
    for (std::uint32_t file = 0; file < files_.size(); ++file)
        if (files_[file].scan) drop(file);
}

void ResidentTargets::open() {
    std::vector<std::uint32_t> files, tiles;
    std::uint64_t bytes = 0;
    for (std::uint32_t file = 0; file < files_.size(); ++file) {
        (isTile(file) ? tiles : files).push_back(file);
        bytes += list_.files[file].bytes;
    }
    if (const std::uint64_t largest = largestTile(); largest > memory_) refuseTile(largest);
    load(files);
    if (bytes > memory_ || tiles.size() > most_tiles_) return;
    load(tiles);
    whole_ = tiles_ == tiles.size();
}

std::uint64_t ResidentTargets::largestTile() const {
    std::uint64_t largest = 0;
    for (const TargetFile& file : list_.files) largest = std::max(largest, file.bytes);
    return largest;
}

void ResidentTargets::bring(std::span<const std::uint32_t> targets) {
    const std::vector<std::uint32_t> files = filesToBring(targets);
    makeRoom(files);
    load(files);
}

void ResidentTargets::use(std::uint32_t target) {
    if (!whole_) files_[list_.targets[target].file].last_used = ++uses_;
}

std::vector<std::uint32_t> ResidentTargets::filesToBring(std::span<const std::uint32_t> targets) const {
    std::vector<std::uint32_t> files;
    std::uint64_t bytes = 0;
    for (const std::uint32_t target : targets) {
        const std::uint32_t file = list_.targets[target].file;
        if (files_[file].scan || std::find(files.begin(), files.end(), file) != files.end()) continue;
        bytes += bytesExpected(file);
        if (!files.empty() && (bytes > memory_ || files.size() == most_tiles_)) break;
        files.push_back(file);
    }
    return files;
}

void ResidentTargets::makeRoom(const std::vector<std::uint32_t>& coming) {
    std::uint64_t bytes = 0;
    for (const std::uint32_t file : coming) bytes += bytesExpected(file);
    while (tile_bytes_ + bytes > memory_ || tiles_ + coming.size() > most_tiles_) {
        const auto oldest = oldestTile();
        if (!oldest) return;
        drop(*oldest);
    }
}

std::optional<std::uint32_t> ResidentTargets::oldestTile() const {
    std::optional<std::uint32_t> oldest;
    for (std::uint32_t file = 0; file < files_.size(); ++file)
        if (files_[file].scan && isTile(file) && (!oldest || files_[file].last_used < files_[*oldest].last_used))
            oldest = file;
    return oldest;
}

void ResidentTargets::load(const std::vector<std::uint32_t>& files) {
    std::vector<DeviceScan> scans(files.size());
    const OnError undo([&] {
        for (DeviceScan& scan : scans) destroyScan(device_, scan);
    });
    forAll(files.size(), [&](std::size_t k) { // they are read from end to end
        const TargetFile& file = list_.files[files[k]];
        if (isTile(files[k])) {
            const TargetSet& set = list_.sets[file.set];
            requireTile(set.set, set.set.tiles[file.tile], set.folder);
        }
        scans[k] = mapTracedScan(file.path);
    });
    for (std::size_t k = 0; k < files.size(); ++k) {
        uploadScan(device_, scans[k], {});
        take(files[k], std::exchange(scans[k], {}));
        // more than was expected: that one was used last, and stays
        while (tile_bytes_ > memory_ && tiles_ > 1) drop(*oldestTile());
    }
}

void ResidentTargets::take(std::uint32_t number, DeviceScan scan) {
    const std::uint64_t declared = list_.files[number].bytes, bytes = std::max(declared, scan.device_bytes);
    if (isTile(number) && bytes > memory_) {
        destroyScan(device_, scan);
        refuseTile(bytes);
    }
    Loaded& file = files_[number];
    file.scan = std::move(scan);
    file.last_used = ++uses_;
    device_bytes_ += file.scan->device_bytes;
    if (isTile(number)) {
        file.bytes = bytes;
        growth_ = std::max(growth_, static_cast<double>(bytes) / static_cast<double>(declared));
        tile_bytes_ += bytes;
        ++tiles_;
        ++tile_loads_;
    }
    const OnError undo([&] { drop(number); });
    for (const std::uint32_t target : list_.files[number].targets) place(target);
}

std::uint64_t ResidentTargets::bytesExpected(std::uint32_t file) const {
    return static_cast<std::uint64_t>(growth_ * static_cast<double>(list_.files[file].bytes));
}

void ResidentTargets::refuseTile(std::uint64_t bytes) const {
    throw Error(ExitCode::kBadUsage, "a tile takes " + mebibytes(bytes) + ", and all that are there at once may take " +
                                         mebibytes(memory_) + ": allow more memory");
}

void ResidentTargets::place(std::uint32_t number) {
    Target& target = list_.targets[number];
    auto placed = std::make_unique<PlacedTarget>();
    placed->scan = &*files_[target.file].scan;
    const DeviceScan& scan = *placed->scan;
    if (!target.core) target.box = boxOf(scan, target.placement);
    const RenderSpace space = spaceOf(target, scan);
    placed->frame = {space, renderPoint(space, target.box.lo), renderPoint(space, target.box.hi)};
    placed->traits = traitsOf(scan, (scan.info.flags & PRO_FLAG_ORIENTED) != 0, target.core.has_value());
    gpu::InstanceParams params = placeInstance(space, scan, target.placement, target.instance);
    placed->in_cube = isUnit(params);
    if (target.core) placeCore(scan, *target.core, params);
    placed->params = createBuffer(device_, "instance parameters", sizeof params, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    placed_[number] = std::move(placed);
    uploadBuffer(device_, placed_[number]->params, &params, sizeof params);
}

void ResidentTargets::drop(std::uint32_t number) {
    Loaded& file = files_[number];
    for (const std::uint32_t target : list_.files[number].targets) {
        if (placed_[target]) destroyBuffer(device_, placed_[target]->params);
        placed_[target].reset();
    }
    device_bytes_ -= file.scan->device_bytes;
    if (isTile(number)) {
        tile_bytes_ -= file.bytes;
        --tiles_;
    }
    destroyScan(device_, *file.scan);
    file = {};
}

} // namespace pointrt
