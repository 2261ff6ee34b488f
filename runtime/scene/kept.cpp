// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/kept.h"

namespace pointrt {

std::vector<HalfSpace> keptOf(std::span<const ClipDescription> clips, const InstanceDescription& instance) {
    if (!instance.visible || instance.deleted) return {nothingKept()};
    return instance.clipped ? keptHalfSpaces(clips) : std::vector<HalfSpace>();
}

} // namespace pointrt
