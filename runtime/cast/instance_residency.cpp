// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/instance_residency.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/base/printable.h"
#include "format/set/open_tile.h"
#include "runtime/device_scene/clip_planes.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/device_scene/device_scene.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/util/memory_text.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// Device allocations per tile: sections, grid, noise, parameters, and a few for further pages.
constexpr std::size_t kTileAllocations = 16;

/// Margin around a file's box as a share of its size, larger than the rounding errors of the box tests.
constexpr double kFileMargin = 1e-4;

/// The box of everything that rays can hit in a file, in cube units: the discs in its entry grid, or its Gaussians.
CubeBox reachOf(const DeviceScan& scan) {
    if (scan.is_gaussian) return scan.gaussian_box;
    const double cell = std::ldexp(1.0, static_cast<int>(scan.index.shift) - PRO_POSITION_BITS);
    CubeBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = cell * scan.index.origin[axis];
        box.high[axis] = box.low[axis] + cell * scan.index.size[axis];
    }
    return box;
}

/// A box in world units around everything that rays can hit, with a margin.
Bounds boxOf(const DeviceScan& scan, const Placement& placement) {
    const CubeBox reach = reachOf(scan);
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, reach.high[axis] - reach.low[axis]);
    pro_info box = scan.info;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.bounds_min[axis] = scan.info.origin[axis] + scan.info.scale * (reach.low[axis] - kFileMargin * longest);
        box.bounds_max[axis] = scan.info.origin[axis] + scan.info.scale * (reach.high[axis] + kFileMargin * longest);
    }
    return placedBounds(placement, box);
}

/// Whether the rows are the identity matrix.
bool isUnit(const gpu::InstanceParams& params) {
    const auto is = [](const gpu::vec4& row, float x, float y, float z) {
        return row.x == x && row.y == y && row.z == z && row.w == 0;
    };
    return is(params.row_x, 1, 0, 0) && is(params.row_y, 0, 1, 0) && is(params.row_z, 0, 0, 1);
}

/// The render space around the cube of an instance's file.
RenderSpace spaceOf(const CastInstance& instance, const DeviceScan& scan) {
    SceneDescription alone;
    alone.instances.push_back({scan.path, instance.placement, {}, {}});
    const pro_info frame = tracedFrame(scan);
    return chooseRenderSpace(alone, {&frame, 1});
}

} // namespace

std::uint64_t splatCount(const InstanceResidency& resident) {
    std::uint64_t count = 0;
    for (const InstanceRun& run : resident.list().scene_instances)
        count += run.set ? resident.list().sets[*run.set].set.splats : resident.find(run.first)->scan->info.splat_count;
    return count;
}

InstanceResidency::InstanceResidency(Device& device, InstanceList list, std::uint64_t memory)
    : device_(device), list_(std::move(list)), memory_(tileMemory(device, memory)),
      most_tiles_(std::max<std::size_t>(1, device.limits.maxMemoryAllocationCount / kTileAllocations)),
      slots_(list_.files.size()), placed_(list_.instances.size()) {
    const OnError undo([&] { destroy(); });
    open();
}

InstanceResidency::~InstanceResidency() { destroy(); }

void InstanceResidency::destroy() {
    for (std::uint32_t file = 0; file < slots_.size(); ++file)
        if (slots_[file]) evict(file);
}

void InstanceResidency::open() {
    std::vector<std::uint32_t> files, tiles;
    std::uint64_t bytes = 0;
    for (std::uint32_t file = 0; file < slots_.size(); ++file) {
        (isTile(file) ? tiles : files).push_back(file);
        bytes += list_.files[file].bytes;
    }
    if (const std::uint64_t largest = largestTile(); largest > memory_) refuseTile(largest);
    loadFiles(files);
    requireFiltered();
    if (bytes > memory_ || tiles.size() > most_tiles_) return;
    loadFiles(tiles);
    complete_ = resident_.evictable() == tiles.size();
}

std::uint64_t InstanceResidency::largestTile() const {
    std::uint64_t largest = 0;
    for (const InstanceFile& file : list_.files) largest = std::max(largest, file.bytes);
    return largest;
}

void InstanceResidency::load(std::span<const std::uint32_t> instances) {
    const std::vector<std::uint32_t> files = filesToLoad(instances);
    makeRoom(files);
    loadFiles(files);
}

void InstanceResidency::use(std::uint32_t instance) {
    if (!complete_) resident_.use(slots_[list_.instances[instance].file].value());
}

std::vector<std::uint32_t> InstanceResidency::filesToLoad(std::span<const std::uint32_t> instances) const {
    std::vector<std::uint32_t> files;
    std::uint64_t bytes = 0;
    for (const std::uint32_t instance : instances) {
        const std::uint32_t file = list_.instances[instance].file;
        if (slots_[file] || std::find(files.begin(), files.end(), file) != files.end()) continue;
        bytes += bytesExpected(file);
        if (!files.empty() && (bytes > memory_ || files.size() == most_tiles_)) break;
        files.push_back(file);
    }
    return files;
}

void InstanceResidency::makeRoom(const std::vector<std::uint32_t>& coming) {
    std::uint64_t bytes = 0;
    for (const std::uint32_t file : coming) bytes += bytesExpected(file);
    while (resident_.bytes() + bytes > memory_ || resident_.evictable() + coming.size() > most_tiles_)
        if (!evictOldest()) return;
}

/// Evicts the least recently used tile. False if no tile is resident.
bool InstanceResidency::evictOldest() {
    const auto oldest = resident_.leastRecentlyUsed([](std::uint32_t) { return true; });
    if (oldest) evict(files_[*oldest]);
    return oldest.has_value();
}

void InstanceResidency::loadFiles(const std::vector<std::uint32_t>& files) {
    std::vector<DeviceScan> scans(files.size());
    const OnError undo([&] {
        for (DeviceScan& scan : scans) destroyScan(device_, scan);
    });
    forAll(files.size(), [&](std::size_t k) { // in parallel, since opening a file reads and checks all of it
        const InstanceFile& file = list_.files[files[k]];
        if (isTile(files[k])) {
            const InstanceSet& set = list_.sets[file.set];
            requireTile(set.set, set.set.tiles[file.tile], set.folder);
        }
        scans[k] = mapTracedScan(file.path);
    });
    for (std::size_t k = 0; k < files.size(); ++k) {
        uploadScan(device_, scans[k], {});
        add(files[k], std::exchange(scans[k], {}));
        // a tile may take more than expected; the one just loaded is the most recently used, so it is not evicted
        while (resident_.bytes() > memory_ && resident_.evictable() > 1) evictOldest();
    }
}

void InstanceResidency::add(std::uint32_t number, DeviceScan scan) {
    if (isTile(number) && scan.is_gaussian) {
        destroyScan(device_, scan);
        throw Error(ExitCode::kBadInput,
                    list_.files[number].path +
                        ": belongs to another set (the tile or the set holds Gaussians, but not both)");
    }
    const std::uint64_t declared = list_.files[number].bytes, device_bytes = scan.device_bytes;
    const std::uint64_t bytes = std::max(declared, device_bytes);
    if (isTile(number) && bytes > memory_) {
        destroyScan(device_, scan);
        refuseTile(bytes);
    }
    const std::uint32_t slot = isTile(number) ? resident_.add(std::move(scan), bytes, Eviction::kAllowed)
                                              : resident_.add(std::move(scan), 0, Eviction::kNever);
    slots_[number] = slot;
    resident_.use(slot);
    device_bytes_ += device_bytes;
    const OnError undo([&] { evict(number); });
    files_.resize(std::max<std::size_t>(files_.size(), slot + 1));
    files_[slot] = number;
    if (isTile(number)) {
        growth_ = std::max(growth_, static_cast<double>(bytes) / static_cast<double>(declared));
        ++tile_loads_;
    }
    for (const std::uint32_t instance : list_.files[number].instances) place(instance);
}

std::uint64_t InstanceResidency::bytesExpected(std::uint32_t file) const {
    return static_cast<std::uint64_t>(growth_ * static_cast<double>(list_.files[file].bytes));
}

void InstanceResidency::refuseTile(std::uint64_t bytes) const {
    const SizeAndLimit shown = sizeAndLimit(bytes, memory_, mebibytes);
    throw Error(ExitCode::kBadUsage,
                "one tile needs " + shown.size + " but the memory limit is " + shown.limit + "; raise it");
}

/// The splats of an instance that its filters show; nullopt: all of them.
std::optional<PaintedSplats> InstanceResidency::filtered(const CastInstance& instance, const DeviceScan& scan) {
    const InstanceRun& run = list_.scene_instances[instance.scene_instance];
    InstanceDescription described;
    described.placement = instance.placement;
    constexpr Vec3 kDefaultUp{0, 1, 0}; // as in pictures
    const Vec3 up = run.up ? *run.up : knownUp(scan, instance.placement).value_or(kDefaultUp);
    SplatPaint paint;
    paint.selections = selectionsOf({&scan, &described}, run.filters, up);
    if (paint.selections.empty()) return std::nullopt;
    return paintScan(device_, scan, paint);
}

/// Refuses filters by an attribute that no scan has. Tiles have the attributes of their set.
void InstanceResidency::requireFiltered() const {
    for (const InstanceRun& run : list_.scene_instances)
        for (const FilterDescription& filter : run.filters)
            if (hidesSplats(filter) && !hasAttribute(filter.shown.attribute))
                throw Error(ExitCode::kBadInput,
                            filter.place + "no scan has an attribute \"" + printable(filter.shown.attribute) + "\"");
}

bool InstanceResidency::hasAttribute(const std::string& word) const {
    const auto in_scan = [&](const InstanceRun& run) {
        const ResidentInstance* const first = find(run.first);
        return first && !first->scan->is_gaussian && attributeNumbers(first->scan->file, word).has_value();
    };
    const auto in_set = [&](const InstanceSet& set) {
        const std::vector<SetAttribute>& attributes = set.set.attributes;
        return std::any_of(attributes.begin(), attributes.end(),
                           [&](const SetAttribute& each) { return each.name == attributeWord(word); });
    };
    return word == kHeight || std::any_of(list_.scene_instances.begin(), list_.scene_instances.end(), in_scan) ||
           std::any_of(list_.sets.begin(), list_.sets.end(), in_set);
}

void InstanceResidency::place(std::uint32_t number) {
    CastInstance& instance = list_.instances[number];
    auto placed = std::make_unique<ResidentInstance>();
    placed->scan = &resident_[slots_[instance.file].value()];
    const DeviceScan& scan = *placed->scan;
    if (!instance.core) instance.box = boxOf(scan, instance.placement);
    const RenderSpace space = spaceOf(instance, scan);
    placed->frame = {space, renderPoint(space, instance.box.lo), renderPoint(space, instance.box.hi)};
    const std::vector<HalfSpace>& kept = list_.scene_instances[instance.scene_instance].kept;
    placed->traits =
        traitsOf(scan, (scan.info.flags & PRO_FLAG_ORIENTED) != 0, instance.core.has_value(), !kept.empty());
    gpu::InstanceParams params = makeInstanceParams(space, scan, instance.placement, instance.scene_instance);
    placed->in_cube = isUnit(params);
    if (instance.core) setCoreBox(scan, *instance.core, params);
    setClipPlanes(kept, instance.placement, scan, params);
    placed->params = createBuffer(device_, "instance parameters", sizeof params, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    placed_[number] = std::move(placed);
    uploadBuffer(device_, placed_[number]->params, &params, sizeof params);
    placed_[number]->painted = filtered(instance, scan);
}

void InstanceResidency::evict(std::uint32_t number) {
    for (const std::uint32_t instance : list_.files[number].instances) {
        if (!placed_[instance]) continue;
        destroyBuffer(device_, placed_[instance]->params);
        if (placed_[instance]->painted) destroyPaintedSplats(device_, *placed_[instance]->painted);
        placed_[instance].reset();
    }
    DeviceScan scan = resident_.remove(slots_[number].value());
    slots_[number].reset();
    device_bytes_ -= scan.device_bytes;
    destroyScan(device_, scan);
}

} // namespace pointrt
