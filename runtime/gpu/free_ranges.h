// SPDX-License-Identifier: Apache-2.0
// The unused parts of a block that is handed out in ranges.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace pointrt {

class FreeRanges {
public:
    /// Starts with a block of this many bytes, all unused.
    explicit FreeRanges(std::uint64_t bytes) : total_(bytes) { gaps_[0] = bytes; }

    /// Takes a range: its offset, a multiple of alignment, or nullopt if no gap has room for it. First fit: ranges that
    /// are taken together are mostly freed together.
    std::optional<std::uint64_t> take(std::uint64_t bytes, std::uint64_t alignment);
    /// Returns a range that was taken.
    void give(std::uint64_t offset, std::uint64_t bytes);
    /// Whether all of the block is unused.
    bool areAll() const { return gaps_.size() == 1 && gaps_.begin()->second == total_; }

private:
    std::uint64_t total_ = 0;
    std::map<std::uint64_t, std::uint64_t> gaps_; ///< offset to size
};

} // namespace pointrt
