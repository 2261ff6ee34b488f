// SPDX-License-Identifier: Apache-2.0
// Gathers photons (caustics) at the points of LIST_DIRECT_LIGHT.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/film.glsl"
#include "shaders/shade/caustic_light.glsl"

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    if (path == NO_INDEX) return;
    Material row = loadMaterial(query.material & SURFACE_MATERIAL_MASK);
    Bsdf bsdf = makeBsdf(row, query.albedo, false, dot(query.normal, query.view));
    vec3 light = causticLight(true, query, row, bsdf);
    film[filmIndex(path, LAYER_CAUSTIC)].rgb += light;
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}
