// SPDX-License-Identifier: Apache-2.0
// What a surface sends on of the light that mirrors and glass have bundled on it.
#ifndef POINTRT_SHADERS_CAUSTIC_LIGHT_GLSL
#define POINTRT_SHADERS_CAUSTIC_LIGHT_GLSL
#include "shaders/shade/caustic.glsl"
#include "shaders/shade/make_bsdf.glsl"

// row, bsdf: of the point that asks. asks: whether this lane has one.
vec3 causticLight(bool asks, DirectLightQuery query, Material row, Bsdf bsdf) {
    if (!isClassic()) bsdf.mirrored = 0.0; // no rays of its own stand for a part of the glossy lobe
    vec3 albedo = gathersPhotons(row) ? smoothAlbedo(bsdf) : vec3(0.0);
    vec3 light = query.throughput * albedo * causticIrradiance(asks, query.position, query.normal) * (1.0 / kPi);
    return asks ? light : vec3(0.0); // what else stands there may be no number
}

#endif
