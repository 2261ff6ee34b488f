// SPDX-License-Identifier: Apache-2.0
// Photons sorted for shaders/light/caustic.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/photon_layout.h"

namespace pointrt {

struct PhotonMap {
    std::vector<gpu::Photon> photons;   ///< by the bucket of the cell that each is in
    std::vector<std::uint32_t> buckets; ///< PHOTON_BUCKETS + 1 words and the lists that they point to
    gpu::CausticFrame frame{};
};

/// Gives each photon a level, sorts and lists them. The finest discs are as wide as where
/// light is bundled tightly kKernelPhotons lie around a photon, at most kMaxRadius of scene_radius. No photons: an
/// empty map.
PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius);

} // namespace pointrt
