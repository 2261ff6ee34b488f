// SPDX-License-Identifier: Apache-2.0
// Photons on their way from the lights to what mirrors or refracts them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/light/photon.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// About count paths, each with its flux, from all lights with a place or direction (no sky images) to all targets,
/// in proportion to the light that each light sends to each target. Directions are quasi-random: the same for the same
/// arguments. Of a pair of light and target all of what the light sends into the target's sphere is sent; what meets
/// something else on the way does not count (shaders/integrator/photon.comp.glsl).
std::vector<gpu::PathState> emitPhotons(std::span<const gpu::Light> lights, std::span<const PhotonTarget> targets,
                                        RenderSphere scene, std::uint32_t count);

} // namespace pointrt
