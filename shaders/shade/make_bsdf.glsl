// SPDX-License-Identifier: Apache-2.0
// A surface's BSDF as the integrator wants it.
#ifndef POINTRT_SHADERS_MAKE_BSDF_GLSL
#define POINTRT_SHADERS_MAKE_BSDF_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/shade/material.glsl"

bool isClassic() { return !integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE); }

// The kinds that show where light comes from, a bit each.
#define SHOWS_DIRECTION(number, NAME, Name, word, label, lobes, traits)                                                \
    | (((traits) & MATERIAL_SHOWS_DIRECTION) != 0u ? 1u << number : 0u)
const uint kShowDirection = 0u MATERIALS(SHOWS_DIRECTION);

// Whether photons bring it the light of caustics. They tell how much arrives but not from where, which is what metals
// show: integrators by chance leave those to rays that find lamps.
bool gathersPhotons(Material row) { return isClassic() || (kShowDirection >> materialKind(row) & 1u) == 0u; }

// cosine: of the angle between normal and view.
Bsdf makeBsdf(Material row, vec3 albedo, bool back, float cosine) {
    if (integratorHas(kIntegrator, INTEGRATOR_GLOSSES_HIGHLIGHTS)) row.gloss.w = glossedMirrorShare(row, cosine);
    return materialBsdf(row, albedo, back, cosine);
}

#endif
