// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/resident_files.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pointrt {

ResidentFiles::Slot ResidentFiles::add(DeviceScan scan, std::uint64_t bytes, Eviction eviction) {
    const auto free = std::find(slots_.begin(), slots_.end(), nullptr);
    const auto slot = static_cast<Slot>(free - slots_.begin());
    order_.reserve(order_.size() + 1);
    if (free == slots_.end()) slots_.emplace_back();
    slots_[slot] = std::make_unique<Resident>(Resident{std::move(scan), bytes, 0, eviction});
    order_.push_back(slot);
    bytes_ += bytes;
    if (eviction == Eviction::kAllowed) ++evictable_;
    return slot;
}

DeviceScan ResidentFiles::remove(Slot slot) {
    const std::unique_ptr<Resident> file = std::move(slots_[slot]);
    std::erase(order_, slot);
    bytes_ -= file->bytes;
    if (file->eviction == Eviction::kAllowed) --evictable_;
    return std::move(file->scan);
}

void ResidentFiles::use(Slot slot) { slots_[slot]->last_used = ++uses_; }

std::optional<ResidentFiles::Slot> ResidentFiles::find(const std::string& path) const {
    const auto found =
        std::find_if(order_.begin(), order_.end(), [&](Slot slot) { return slots_[slot]->scan.path == path; });
    return found == order_.end() ? std::nullopt : std::optional(*found);
}

const DeviceScan& ResidentFiles::at(Slot slot) const {
    if (slot >= slots_.size() || !slots_[slot]) throw std::out_of_range("no file is resident in this slot");
    return slots_[slot]->scan;
}

} // namespace pointrt
