// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/memory_text.h"

namespace pointrt {

std::string gibibytes(std::uint64_t bytes) {
    constexpr std::uint64_t kTenth = (1ull << 30) / 10;
    const std::uint64_t tenths = bytes / kTenth + (bytes % kTenth != 0);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GiB";
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

SizeAndLimit sizeAndLimit(std::uint64_t size, std::uint64_t limit, std::string (*inUnit)(std::uint64_t bytes)) {
    const SizeAndLimit rounded{inUnit(size), inUnit(limit)};
    if (rounded.size != rounded.limit) return rounded;
    return {std::to_string(size) + " bytes", std::to_string(limit) + " bytes"};
}

} // namespace pointrt
