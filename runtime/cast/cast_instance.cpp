// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/cast_instance.h"

#include <algorithm>

namespace pointrt {

std::optional<std::uint32_t> findInstance(const InstanceList& list, std::uint32_t scene_instance, std::uint32_t tile) {
    if (scene_instance >= list.scene_instances.size()) return std::nullopt;
    const InstanceRun& run = list.scene_instances[scene_instance];
    if (!run.set) return run.first;
    const std::vector<std::uint32_t>& tiles = list.sets[*run.set].tiles;
    const auto found = std::lower_bound(tiles.begin(), tiles.end(), tile);
    if (found == tiles.end() || *found != tile) return std::nullopt;
    return run.first + static_cast<std::uint32_t>(found - tiles.begin());
}

} // namespace pointrt
