// SPDX-License-Identifier: Apache-2.0
// Caustics on the points that ask for light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light/direct_light.glsl"
#include "shaders/material/make_bsdf.glsl"
#include "shaders/film/film.glsl"
#include "shaders/light/caustic.glsl"

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    if (path == NO_INDEX) return;
    vec3 normal = query.normal;
    Material row = loadMaterial(query.material & SURFACE_MATERIAL_MASK);
    Bsdf bsdf = makeBsdf(row, query.albedo, false, dot(normal, query.view));
    if (!isClassic()) bsdf.mirrored = 0.0; // no rays of its own stand for a part of the glossy lobe
    vec3 irradiance = causticIrradiance(query.position, normal);
    vec3 albedo = gathersPhotons(row) ? smoothAlbedo(bsdf) : vec3(0.0);
    vec3 light = query.throughput * albedo * irradiance * (1.0 / kPi);
    film[filmIndex(path, LAYER_CAUSTIC)].rgb += light;
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}
