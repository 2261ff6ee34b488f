// SPDX-License-Identifier: Apache-2.0
// The BSDF of a surface for the integrator.
#ifndef POINTRT_SHADERS_MAKE_BSDF_GLSL
#define POINTRT_SHADERS_MAKE_BSDF_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/shade/material.glsl"

// True for the integrators phong and whitted.
bool isClassic() { return !integratorHas(kIntegrator, INTEGRATOR_IS_STOCHASTIC); }

// Mask of the material kinds with MATERIAL_SHOWS_DIRECTION.
#define SHOWS_DIRECTION(number, NAME, Name, word, label, lobes, traits)                                                \
    | (((traits) & MATERIAL_SHOWS_DIRECTION) != 0u ? 1u << number : 0u)
const uint kShowDirection = 0u MATERIALS(SHOWS_DIRECTION);

// Whether the surface receives caustics from the photon map. Photons record no direction of light, on which the look of
// metals depends. So stochastic integrators leave caustics on metals to rays that hit lights.
bool gathersPhotons(Material row) { return isClassic() || (kShowDirection >> materialKind(row) & 1u) == 0u; }

// cosine: between normal and view direction.
Bsdf makeBsdf(Material row, vec3 albedo, bool back, float cosine) {
    if (integratorHas(kIntegrator, INTEGRATOR_MIRRORS_HIGHLIGHTS)) row.gloss.w = highlightMirrorShare(row, cosine);
    return materialBsdf(row, albedo, back, cosine);
}

#endif
