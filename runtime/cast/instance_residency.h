// SPDX-License-Identifier: Apache-2.0
// The instances of a ray-cast scene on the device. Files stay resident. If the tiles do not all fit in memory, they are
// loaded as rays need them, and the least recently used are evicted.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/cast/cast_instance.h"
#include "runtime/device_scene/device_scan.h"
#include "runtime/device_scene/resident_files.h"
#include "runtime/device_scene/scene_paint.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/render/instance_traits.h"

namespace pointrt {

/// The render space that rays are packed in, and the box of what they can hit there.
struct RayFrame {
    RenderSpace space;
    Vec3 low, high; ///< a box around everything that can be hit, render units
};

/// An instance on the device. It has its own render space, so that floats are equally precise wherever it lies.
struct ResidentInstance {
    const DeviceScan* scan = nullptr;
    RayFrame frame;
    InstanceTraits traits;
    bool in_cube = false;                 ///< its render space is exactly its cube
    Buffer params;                        ///< gpu::InstanceParams
    std::optional<PaintedSplats> painted; ///< its splats without those that filters hide
};

class InstanceResidency;
/// The number of splats of all scene instances; for tile sets, the original splats, each once.
std::uint64_t splatCount(const InstanceResidency& resident);

/// Not thread-safe, except that const members may be called from several threads while no other member runs.
class InstanceResidency {
public:
    /// Loads all files, and the tiles if all of them fit. Sets the instances' boxes.
    /// @param device outlives this
    /// @param memory limit for the tiles, bytes in files and on the device
    /// Throws Error: kBadInput "FILE: reason"; kBadUsage if a tile exceeds the limit; kCannotRun if the device is too
    /// small.
    InstanceResidency(Device& device, InstanceList list, std::uint64_t memory);
    ~InstanceResidency();
    InstanceResidency(const InstanceResidency&) = delete;
    InstanceResidency& operator=(const InstanceResidency&) = delete;

    const InstanceList& list() const { return list_; }
    /// Whether all instances are resident, permanently.
    bool isComplete() const { return complete_; }
    /// Null if the instance is not resident.
    const ResidentInstance* find(std::uint32_t instance) const { return placed_[instance].get(); }

    /// Loads the first of these instances that are not resident, as many as fit and at least one, and evicts others for
    /// them. Throws Error as the constructor does for files.
    void load(std::span<const std::uint32_t> instances);
    /// Marks an instance as used now.
    void use(std::uint32_t instance);

    /// Tiles loaded so far; a tile loaded twice counts twice.
    std::uint64_t tileLoads() const { return tile_loads_; }
    std::uint64_t deviceBytes() const { return device_bytes_; }

private:
    void destroy();
    void open();
    bool isTile(std::uint32_t file) const { return list_.files[file].tile != kNoTile; }
    std::uint64_t largestTile() const;
    std::uint64_t bytesExpected(std::uint32_t file) const;
    [[noreturn]] void refuseTile(std::uint64_t bytes) const;
    std::vector<std::uint32_t> filesToLoad(std::span<const std::uint32_t> instances) const;
    void makeRoom(const std::vector<std::uint32_t>& coming);
    bool evictOldest();
    void loadFiles(const std::vector<std::uint32_t>& files);
    void add(std::uint32_t file, DeviceScan scan);
    std::optional<PaintedSplats> filtered(const CastInstance& instance, const DeviceScan& scan);
    void requireFiltered() const;
    bool hasAttribute(const std::string& word) const;
    void place(std::uint32_t instance);
    void evict(std::uint32_t file);

    Device& device_;
    InstanceList list_;
    std::uint64_t memory_;
    std::size_t most_tiles_ = 0; ///< limit for resident tiles, by the device's limit for allocations
    bool complete_ = false;
    ResidentFiles resident_;                                ///< tiles may be evicted and count towards its bytes
    std::vector<std::optional<std::uint32_t>> slots_;       ///< in resident_, of each of list_.files
    std::vector<std::uint32_t> files_;                      ///< in list_.files, of each slot of resident_
    std::vector<std::unique_ptr<ResidentInstance>> placed_; ///< of list_.instances
    /// Largest ratio so far of a tile's bytes on the device to its file's: above 1 if its index was built.
    double growth_ = 1;
    std::atomic<std::uint64_t> tile_loads_{0}, device_bytes_{0};
};

} // namespace pointrt
