// SPDX-License-Identifier: Apache-2.0
// A material's row with what a point of its surface adds.
#ifndef POINTRT_SHADERS_MATTER_GLSL
#define POINTRT_SHADERS_MATTER_GLSL
#include "shaders/frame/bindings.glsl"
#include "shaders/material/material.glsl"

bool isClassic() { return !integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE); }

// Whether photons bring it the light of caustics. They tell how much arrives but not from where, which is what metals
// show: path leaves those to rays that find lamps by chance.
bool gathersPhotons(Material row) { return isClassic() || int(row.gloss.x) != MATERIAL_METAL; }

// cosine: of the angle between normal and view.
SurfaceMaterial matterOf(Material row, vec3 albedo, bool back, float cosine) {
    if (integratorHas(kIntegrator, INTEGRATOR_GLOSSES_HIGHLIGHTS)) row.gloss.w = glossedMirrorShare(row, cosine);
    return surfaceMaterial(row, albedo, back, cosine);
}

#endif
