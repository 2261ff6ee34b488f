// SPDX-License-Identifier: Apache-2.0
// Emission of photons from the lights towards everything that mirrors or refracts them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/photon.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Selects the photons to emit: another set for each map and each seed.
struct PhotonSequence {
    std::uint32_t map = 0, seed = 0;
};

/// About count photon paths, each with its flux, from all lights except sky images to all targets, in proportion to the
/// flux from each light to each target. Directions are quasi-random and deterministic; those of all maps of a seed form
/// one even sequence. All of a light's emission into the bounding sphere of a target is sampled; photons that first hit
/// something else are dropped (shaders/shade/photon.comp.glsl).
class PhotonEmission {
public:
    /// lights must outlive it.
    PhotonEmission(std::span<const gpu::Light> lights, std::vector<PhotonTarget> targets, RenderSphere scene,
                   std::uint32_t count, PhotonSequence sequence = {});
    PhotonEmission(const PhotonEmission&) = delete;
    PhotonEmission& operator=(const PhotonEmission&) = delete;

    /// Photons of the map; an upper bound of the number of paths.
    std::uint64_t count() const { return count_; }
    /// The next paths, at most `most`; fewer only if they are the last.
    std::vector<gpu::PathState> next(std::size_t most);

private:
    struct Pair {
        const gpu::Light& light;
        const PhotonTarget& target;
        std::uint64_t first = 0, count = 0; ///< numbers of its photons in the map
    };

    gpu::PathState pathOf(std::uint64_t photon) const;

    std::vector<PhotonTarget> targets_;
    RenderSphere scene_;
    std::vector<Pair> pairs_; ///< in order of first; each has photons
    std::uint64_t count_ = 0, sent_ = 0;
    std::array<double, 4> shift_{}; ///< of the quasi-random numbers
};

} // namespace pointrt
