// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/target.h"

#include <algorithm>

namespace pointrt {

std::optional<std::uint32_t> findTarget(const TargetList& list, std::uint32_t instance, std::uint32_t tile) {
    if (instance >= list.instances.size()) return std::nullopt;
    const TargetRun& run = list.instances[instance];
    if (!run.set) return run.first;
    const std::vector<std::uint32_t>& tiles = list.sets[*run.set].tiles;
    const auto found = std::lower_bound(tiles.begin(), tiles.end(), tile);
    if (found == tiles.end() || *found != tile) return std::nullopt;
    return run.first + static_cast<std::uint32_t>(found - tiles.begin());
}

} // namespace pointrt
