// SPDX-License-Identifier: Apache-2.0
// Caustic light that a surface reflects to the viewer.
#ifndef POINTRT_SHADERS_CAUSTIC_LIGHT_GLSL
#define POINTRT_SHADERS_CAUSTIC_LIGHT_GLSL
#include "shaders/shade/caustic.glsl"
#include "shaders/shade/make_bsdf.glsl"

// The light towards the query's view direction; 0 if not live. row, bsdf: of the surface at the query.
vec3 causticLight(bool live, DirectLightQuery query, Material row, Bsdf bsdf) {
    if (!isClassic()) bsdf.mirrored = 0.0; // no separate mirror rays take a share of the glossy lobe
    vec3 albedo = gathersPhotons(row) ? smoothAlbedo(bsdf) : vec3(0.0);
    vec3 light = query.throughput * albedo * causticIrradiance(live, query.position, query.normal) * (1.0 / kPi);
    return live ? light : vec3(0.0); // idle lanes may have NaN
}

#endif
