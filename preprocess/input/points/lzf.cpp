// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/lzf.h"

#include <algorithm>
#include <cstdint>

namespace pointrt {
namespace {

/// Copies from the output itself; the ranges overlap where a run is repeated.
void copyBack(std::string& unpacked, std::size_t distance, std::size_t length) {
    for (std::size_t i = 0; i < length; ++i) unpacked.push_back(unpacked[unpacked.size() - distance]);
}

} // namespace

bool unpackLzf(std::string_view packed, std::size_t unpacked_size, std::string& unpacked) {
    unpacked.clear();
    unpacked.reserve(std::min(unpacked_size, packed.size() * kLargestLzfGain));
    std::size_t at = 0;
    const auto byteAt = [&](std::size_t index) -> std::size_t { return static_cast<std::uint8_t>(packed[index]); };
    while (at < packed.size()) {
        const std::size_t control = byteAt(at++);
        if (control < 32) { // control + 1 literal bytes
            const std::size_t length = control + 1;
            if (length > unpacked_size - unpacked.size()) return false;
            unpacked.append(packed.substr(at, length));
            if (length > packed.size() - at) return false;
            at += length;
            continue;
        }
        std::size_t length = control >> 5; // the upper 3 bits; 7 means that another byte follows
        const std::size_t more = length == 7 ? 2 : 1;
        if (more > packed.size() - at) return false;
        if (length == 7) length += byteAt(at++);
        length += 2;
        const std::size_t distance = ((control & 31) << 8 | byteAt(at++)) + 1;
        if (distance > unpacked.size() || length > unpacked_size - unpacked.size()) return false;
        copyBack(unpacked, distance, length);
    }
    return unpacked.size() == unpacked_size;
}

} // namespace pointrt
