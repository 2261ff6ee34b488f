// SPDX-License-Identifier: Apache-2.0
// What a surface sends on of a light that reaches it.
#ifndef POINTRT_SHADERS_SCATTERED_LIGHT_GLSL
#define POINTRT_SHADERS_SCATTERED_LIGHT_GLSL
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/make_bsdf.glsl"

// What a surface makes of a light's sample. Path tracing leaves out what rays scattered by chance towards a lamp bring
// (balance heuristic, Veach 1997); but for a sun's disc, which they leave out.
vec3 scatteredLight(Bsdf bsdf, vec3 normal, vec3 view, LightSample to, uint kind, float chance) {
    if (isClassic()) return classicBsdf(bsdf, normal, view, to.direction, to.pdf > 0.0);
    float scatter_pdf = bsdfPdf(bsdf, normal, view, to.direction), light_pdf = to.pdf * chance;
    float share = light_pdf > 0.0 && isFoundByChance(kind) ? light_pdf / (light_pdf + scatter_pdf) : 1.0;
    return evaluateBsdf(bsdf, normal, view, to.direction) * (share / chance);
}

#endif
