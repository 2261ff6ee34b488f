// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/free_ranges.h"

#include <iterator>

namespace pointrt {

std::optional<std::uint64_t> FreeRanges::take(std::uint64_t bytes, std::uint64_t alignment) {
    for (const auto& [start, size] : gaps_) {
        const std::uint64_t offset = (start + alignment - 1) / alignment * alignment, lost = offset - start;
        if (lost > size || bytes > size - lost) continue;
        const std::uint64_t gap = start, end = start + size;
        gaps_.erase(gap);
        if (lost > 0) gaps_[gap] = lost;
        if (offset + bytes < end) gaps_[offset + bytes] = end - offset - bytes;
        return offset;
    }
    return std::nullopt;
}

void FreeRanges::give(std::uint64_t offset, std::uint64_t bytes) {
    auto gap = gaps_.emplace(offset, bytes).first;
    if (const auto next = std::next(gap); next != gaps_.end() && gap->first + gap->second == next->first) {
        gap->second += next->second;
        gaps_.erase(next);
    }
    if (gap == gaps_.begin()) return;
    if (const auto before = std::prev(gap); before->first + before->second == gap->first) {
        before->second += gap->second;
        gaps_.erase(gap);
    }
}

} // namespace pointrt
