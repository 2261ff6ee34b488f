// SPDX-License-Identifier: Apache-2.0
// Which .pro files are on the device, and which of them to evict: stable slots, byte accounting, least recently used
// first. The renderer and ray casts share it, and each decides for itself what to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device_scene/device_scan.h"

namespace pointrt {

/// Whether a file may be evicted.
enum class Eviction : std::uint8_t { kNever, kAllowed };

/// Files in slots. The number of a file's slot and the address of its scan do not change while the file is resident;
/// the lowest free slot is used next. Frees no device memory: the caller that removes a scan destroys it.
class ResidentFiles {
public:
    using Slot = std::uint32_t;

    /// Visits the resident files in the order in which they were added.
    template <typename Files, typename Scan>
    class Iterator {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = DeviceScan;
        using difference_type = std::ptrdiff_t;
        using pointer = Scan*;
        using reference = Scan&;

        Iterator() = default;
        Iterator(Files* files, std::size_t place) : files_(files), place_(place) {}
        reference operator*() const { return (*files_)[files_->slots()[place_]]; }
        pointer operator->() const { return &**this; }
        Iterator& operator++() { return ++place_, *this; }
        Iterator operator++(int) { return {files_, place_++}; }
        bool operator==(const Iterator& other) const = default;

    private:
        Files* files_ = nullptr;
        std::size_t place_ = 0;
    };

    /// @param bytes that the file adds to bytes()
    /// A file that was never used is the first to be evicted.
    Slot add(DeviceScan scan, std::uint64_t bytes, Eviction eviction);
    /// Takes the scan out of its slot and frees the slot.
    DeviceScan remove(Slot slot);
    /// Marks the file as used now.
    void use(Slot slot);

    /// The least recently used file among those that may be evicted and for which mayGo(slot) is true; among
    /// several that were never used, the one added first.
    template <typename MayGo>
    std::optional<Slot> leastRecentlyUsed(const MayGo& mayGo) const {
        std::optional<Slot> oldest;
        for (const Slot slot : order_) {
            const Resident& file = *slots_[slot];
            if (file.eviction == Eviction::kNever || !mayGo(slot)) continue;
            if (!oldest || file.last_used < slots_[*oldest]->last_used) oldest = slot;
        }
        return oldest;
    }

    std::optional<Slot> find(const std::string& path) const;
    /// slot must contain a file.
    DeviceScan& operator[](Slot slot) { return slots_[slot]->scan; }
    const DeviceScan& operator[](Slot slot) const { return slots_[slot]->scan; }
    /// Throws std::out_of_range if slot contains no file.
    const DeviceScan& at(Slot slot) const;

    /// Occupied slots, in the order in which their files were added.
    const std::vector<Slot>& slots() const { return order_; }
    std::size_t size() const { return order_.size(); }
    /// Files that may be evicted.
    std::size_t evictable() const { return evictable_; }
    std::uint64_t bytes() const { return bytes_; }

    using iterator = Iterator<ResidentFiles, DeviceScan>;
    using const_iterator = Iterator<const ResidentFiles, const DeviceScan>;
    iterator begin() { return {this, 0}; }
    iterator end() { return {this, order_.size()}; }
    const_iterator begin() const { return {this, 0}; }
    const_iterator end() const { return {this, order_.size()}; }

private:
    struct Resident {
        DeviceScan scan;
        std::uint64_t bytes = 0;
        std::uint64_t last_used = 0; ///< value of uses_ at the last use; 0: never used
        Eviction eviction = Eviction::kAllowed;
    };

    std::vector<std::unique_ptr<Resident>> slots_; ///< null: free
    std::vector<Slot> order_;
    std::size_t evictable_ = 0;
    std::uint64_t bytes_ = 0, uses_ = 0;
};

} // namespace pointrt
