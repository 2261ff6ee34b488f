// SPDX-License-Identifier: Apache-2.0
#include "format/points/input_order.h"

#include <algorithm>
#include <numeric>

namespace pointrt {

std::vector<std::uint32_t> inputOrder(const ProFile& file) {
    std::vector<std::uint32_t> splats(file.info().splat_count);
    std::iota(splats.begin(), splats.end(), 0u);
    const auto order = file.order();
    if (order.empty()) return splats;
    if (file.sampling().filled_count > 0)
        std::erase_if(splats, [&](std::uint32_t splat) { return order[splat] >= file.sampling().input_count; });
    std::sort(splats.begin(), splats.end(),
              [&](std::uint32_t a, std::uint32_t b) { return order[a] != order[b] ? order[a] < order[b] : a < b; });
    return splats;
}

} // namespace pointrt
