// SPDX-License-Identifier: Apache-2.0
// Rays in Embree's own arrays, so that the call alone is timed.
#pragma once

#include <span>
#include <vector>

#include "tests/support/embree_discs.h"

namespace pointrt::test {

enum class EmbreeMode { kSingle, kPackets }; ///< rtcIntersect1 and rtcOccluded1, or rtcIntersect8 and rtcOccluded8

struct EmbreeRun {
    double seconds = 0;          ///< of tracing on all cores, without filling the arrays
    std::vector<EmbreeHit> hits; ///< in the rays' order; any hit has splat 0 and t 0
};

/// Traces rays once. any_hit: tests by rtcOccluded whether there is any hit. coherent: Embree's hint for packets.
EmbreeRun runEmbree(const EmbreeDiscs& discs, std::span<const Ray> rays, EmbreeMode mode, bool any_hit, bool coherent);

} // namespace pointrt::test
