// SPDX-License-Identifier: Apache-2.0
// Direct light scattered at a surface.
#ifndef POINTRT_SHADERS_SCATTERED_LIGHT_GLSL
#define POINTRT_SHADERS_SCATTERED_LIGHT_GLSL
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/make_bsdf.glsl"

// BSDF times cosine for a light sample, with its multiple importance sampling weight: path tracing weights light
// samples against BSDF samples by the balance heuristic (Veach 1997), except for lights that BSDF samples ignore, such
// as the sun.
vec3 scatteredLight(Bsdf bsdf, vec3 normal, vec3 view, LightSample to, uint kind, float chance) {
    if (kIsAmbient) return vec3(1.0); // the query's throughput includes the BSDF
    if (isClassic()) return classicBsdf(bsdf, normal, view, to.direction, to.pdf > 0.0);
    float scatter_pdf = bsdfPdf(bsdf, normal, view, to.direction), light_pdf = to.pdf * chance;
    float share = light_pdf > 0.0 && isHitByBsdfSamples(kind) ? light_pdf / (light_pdf + scatter_pdf) : 1.0;
    return evaluateBsdf(bsdf, normal, view, to.direction) * (share / chance);
}

#endif
