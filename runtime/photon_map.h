// SPDX-License-Identifier: Apache-2.0
// Photons sorted for shaders/caustic.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/photon_layout.h"

namespace pointrt {

struct PhotonMap {
    std::vector<gpu::Photon> photons;   ///< by bucket
    std::vector<std::uint32_t> buckets; ///< PHOTON_BUCKETS + 1 words: where each one starts
    gpu::CausticFrame frame{};
};

/// Gives each photon a level and sorts them. The finest discs are as wide as the typical photon, most of which lie
/// where light is bundled tightly, has kKernelPhotons around it, at most kMostRadius of scene_radius. No photons: an
/// empty map.
PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius);

} // namespace pointrt
