// SPDX-License-Identifier: Apache-2.0
// Photons sorted for shaders/shade/caustic.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/photon_layout.h"

namespace pointrt {

/// How wide discs are.
struct PhotonDiscs {
    double finest = 0; ///< radius of the finest, before they shrink; 0: by the photons
    double shrink = 1; ///< all of them, by this factor; levels are chosen before
};

struct PhotonMap {
    std::vector<gpu::Photon> photons;   ///< by the bucket of the cell that each is in
    std::vector<std::uint32_t> buckets; ///< PHOTON_BUCKETS + 1 words and the lists that they point to; none: none
    gpu::CausticFrame frame{};
    double finest = 0; ///< PhotonDiscs::finest of the maps to follow
};

/// Gives each photon a level, sorts and lists them. Where discs does not say it, the finest are as wide as where
/// light is bundled tightly kKernelPhotons lie around a photon, at most kMaxRadius of scene_radius. No photons: an
/// empty map.
PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius, PhotonDiscs discs = {});

} // namespace pointrt
