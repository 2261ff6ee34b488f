// SPDX-License-Identifier: Apache-2.0
// Targets on the device. Files stay; where memory has no room for all tiles, these come as rays ask for them, and go in
// the order in which they were used last.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/cast/target.h"
#include "runtime/device_scene/device_scan.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/render/instance_traits.h"

namespace pointrt {

/// Where rays come from and what they can meet.
struct RayFrame {
    RenderSpace space;
    Vec3 low, high; ///< a box around all that can be hit, render units
};

/// A target as programs see it: in a render space of its own, so that floats tell it as finely wherever it stands.
struct PlacedTarget {
    const DeviceScan* scan = nullptr;
    RayFrame frame;
    InstanceTraits traits;
    bool in_cube = false; ///< its render space is its cube, to the bit
    Buffer params;        ///< gpu::InstanceParams
};

class ResidentTargets;
/// Of all instances; of sets the original ones, once.
std::uint64_t splatCount(const ResidentTargets& resident);

/// For one thread at a time where tiles come and go; what does not change anything may be called by any number.
class ResidentTargets {
public:
    /// Puts all files on the device, and the tiles where all of them fit. Fills in the boxes of list.
    /// @param device outlives this
    /// @param memory bytes that tiles may take, in files and on the device
    /// Throws Error: kBadInput "FILE: reason"; kBadUsage where a set has a tile that takes more than the memory;
    /// kCannotRun where the device is too small.
    ResidentTargets(Device& device, TargetList list, std::uint64_t memory);
    ~ResidentTargets();
    ResidentTargets(const ResidentTargets&) = delete;
    ResidentTargets& operator=(const ResidentTargets&) = delete;

    const TargetList& list() const { return list_; }
    /// Whether all are there, and stay.
    bool isWhole() const { return whole_; }
    /// Null where it is not on the device.
    const PlacedTarget* find(std::uint32_t target) const { return placed_[target].get(); }

    /// Brings the first of these that are not there, as many as there is room for, and at least one; those before them
    /// and all others go first where there is none. Throws Error as the constructor does for files.
    void bring(std::span<const std::uint32_t> targets);
    /// Says that rays have asked for it just now.
    void use(std::uint32_t target);

    /// Tiles that were brought, each time counted.
    std::uint64_t tileLoads() const { return tile_loads_; }
    std::uint64_t deviceBytes() const { return device_bytes_; }

private:
    struct Loaded {
        std::optional<DeviceScan> scan;
        std::uint64_t bytes = 0;     ///< that it counts for, of a tile
        std::uint64_t last_used = 0; ///< as uses_ counts
    };
    void destroy();
    void open();
    bool isTile(std::uint32_t file) const { return list_.files[file].tile != kNoTile; }
    std::uint64_t largestTile() const;
    std::uint64_t bytesExpected(std::uint32_t file) const;
    [[noreturn]] void refuseTile(std::uint64_t bytes) const;
    std::vector<std::uint32_t> filesToBring(std::span<const std::uint32_t> targets) const;
    void makeRoom(const std::vector<std::uint32_t>& coming);
    std::optional<std::uint32_t> oldestTile() const;
    void load(const std::vector<std::uint32_t>& files);
    void take(std::uint32_t file, DeviceScan scan);
    void place(std::uint32_t target);
    void drop(std::uint32_t file);

    Device& device_;
    TargetList list_;
    std::uint64_t memory_;
    std::size_t most_tiles_ = 0; ///< on the device at once, by how many allocations it takes
    bool whole_ = false;
    std::vector<Loaded> files_;                         ///< of list_.files
    std::vector<std::unique_ptr<PlacedTarget>> placed_; ///< of list_.targets
    std::uint64_t tile_bytes_ = 0;                      ///< of the tiles that are there
    double growth_ = 1; ///< of tiles to their files, at most, as far as is known: an index that is built takes more
    std::size_t tiles_ = 0;
    std::uint64_t uses_ = 0;
    std::atomic<std::uint64_t> tile_loads_{0}, device_bytes_{0};
};

} // namespace pointrt
