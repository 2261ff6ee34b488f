// SPDX-License-Identifier: Apache-2.0
// The photon map, sorted for shaders/shade/caustic.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/photon_layout.h"

namespace pointrt {

/// Radii of the discs.
struct PhotonDiscs {
    double finest = 0; ///< radius of the finest level before shrinking; 0: chosen from the photons
    double shrink = 1; ///< factor for all radii, applied after levels are chosen
};

struct PhotonMap {
    std::vector<gpu::Photon> photons;   ///< sorted by the bucket of the cell of each
    std::vector<std::uint32_t> buckets; ///< PHOTON_BUCKETS + 1 words and the lists that they point to
    gpu::CausticFrame frame{};
    double finest = 0; ///< PhotonDiscs::finest for later maps
};

/// Assigns a level to each photon, sorts the photons and builds the lists. If discs.finest is 0, the finest discs hold
/// kKernelPhotons where light is most focused, with a radius of at most kMaxRadius times scene_radius. Without photons
/// the map is empty.
PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius, PhotonDiscs discs = {});

} // namespace pointrt
