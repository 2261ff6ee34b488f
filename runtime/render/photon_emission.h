// SPDX-License-Identifier: Apache-2.0
// Photons on their way from the lights to what mirrors or refracts them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/photon.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Which photons set out: those of one map after another, others for each seed.
struct PhotonTurn {
    std::uint32_t map = 0, seed = 0;
};

/// About count paths, each with its flux, from all lights with a place or direction (no sky images) to all targets,
/// in proportion to the light that each light sends to each target. Directions are quasi-random: the same for the same
/// arguments, and those of all maps of a seed one even sequence. Of a pair of light and target all of what the light
/// sends into the target's sphere is sent; what meets something else on the way does not count
/// (shaders/shade/photon.comp.glsl).
class PhotonEmission {
public:
    /// lights must outlive it.
    PhotonEmission(std::span<const gpu::Light> lights, std::vector<PhotonTarget> targets, RenderSphere scene,
                   std::uint32_t count, PhotonTurn turn = {});
    PhotonEmission(const PhotonEmission&) = delete;
    PhotonEmission& operator=(const PhotonEmission&) = delete;

    /// Numbers of photons in the map: no more paths than that.
    std::uint64_t count() const { return count_; }
    /// The next paths, fewer than most where those were the last.
    std::vector<gpu::PathState> next(std::size_t most);

private:
    struct Pair {
        const gpu::Light& light;
        const PhotonTarget& target;
        std::uint64_t first = 0, count = 0; ///< of the map's photons
    };

    gpu::PathState pathOf(std::uint64_t photon) const;

    std::vector<PhotonTarget> targets_;
    RenderSphere scene_;
    std::vector<Pair> pairs_; ///< in order; each has photons
    std::uint64_t count_ = 0, sent_ = 0;
    std::array<double, 4> shift_{}; ///< of the quasi-random numbers
};

} // namespace pointrt
