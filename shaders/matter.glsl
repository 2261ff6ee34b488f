// SPDX-License-Identifier: Apache-2.0
// A material's row with what a point of its surface adds.
#ifndef POINTRT_SHADERS_MATTER_GLSL
#define POINTRT_SHADERS_MATTER_GLSL
#include "bindings.glsl"
#include "material.glsl"

bool isClassic() { return kIntegrator != INTEGRATOR_PATH; }

// cosine: of the angle between normal and view.
SurfaceMaterial matterOf(Material row, vec3 albedo, bool back, float cosine) {
    if (kIntegrator == INTEGRATOR_WHITTED) row.gloss.w = glossedMirrorShare(row, cosine);
    return surfaceMaterial(row, albedo, back, cosine);
}

#endif
