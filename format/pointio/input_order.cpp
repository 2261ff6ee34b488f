// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/input_order.h"

#include <algorithm>
#include <numeric>

namespace pointrt {

namespace {

bool isOfInput(const ProFile& file, std::uint32_t input_index) {
    return file.sampling().filled_count == 0 || input_index < file.sampling().input_count;
}

} // namespace

std::vector<std::uint32_t> inputOrder(const ProFile& file) {
    std::vector<std::uint32_t> splats(file.info().splat_count);
    std::iota(splats.begin(), splats.end(), 0u);
    const auto order = file.order();
    if (order.empty()) return splats;
    std::erase_if(splats, [&](std::uint32_t splat) { return !isOfInput(file, order[splat]); });
    std::sort(splats.begin(), splats.end(),
              [&](std::uint32_t a, std::uint32_t b) { return order[a] != order[b] ? order[a] < order[b] : a < b; });
    return splats;
}

std::uint64_t inputCount(const ProFile& file) {
    const auto order = file.order();
    if (order.empty()) return file.info().splat_count;
    return static_cast<std::uint64_t>(
        std::count_if(order.begin(), order.end(), [&](std::uint32_t index) { return isOfInput(file, index); }));
}

} // namespace pointrt
