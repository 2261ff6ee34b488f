// SPDX-License-Identifier: Apache-2.0
// Light sampling: directions for shadow rays, and the densities of those directions for multiple importance sampling
// (MIS) against BSDF samples that hit the light. The sky is sampled in sky.glsl. Points, normals and distances in
// render units; directions are unit vectors.
//
// Each kind NAME of LIGHT_KINDS (shaders/shared/light_layout.h) has a file that defines all of these:
//   LightSample sampleNAME(Light light, vec3 point, vec2 u)    as sampleLight, for that kind
//   float pdfNAME(Light light, vec3 point, vec3 direction)     as lightPdf
//   vec3 radianceNAME(Light light)                             as lightRadiance
//   const vec2 kMiddleNAME                                     u of a representative direction
//   const bool kBsdfSamplesHitNAME                              whether BSDF samples may hit it (MIS)
#ifndef POINTRT_SHADERS_LIGHTS_GLSL
#define POINTRT_SHADERS_LIGHTS_GLSL

#include "shaders/shade/disc_light.glsl"
#include "shaders/shade/point_light.glsl"
#include "shaders/shade/quad_light.glsl"
#include "shaders/shade/sphere_light.glsl"
#include "shaders/shade/spot_light.glsl"
#include "shaders/shade/sun_light.glsl"

// A program may define which kinds of light it supports.
#ifndef mayHaveLight
#define mayHaveLight(kind) true
#endif

uint lightKind(Light light) { return uint(LIGHT_KIND(light)); }

// Draws a direction from point to the light for u in [0, 1)^2. It may point below the surface; the caller checks.
LightSample sampleLight(Light light, vec3 point, vec2 u) {
    uint kind = lightKind(light);
#define SAMPLE(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return sample##name(light, point, u);
    LIGHT_KINDS(SAMPLE)
#undef SAMPLE
    return LightSample(vec3(0.0, 0.0, 1.0), kLightAfar, vec3(0.0), 0.0);
}

// Density of sampleLight for a direction that must hit the light's shape or the sun's disc, which is not tested; 0 for
// delta lights.
float lightPdf(Light light, vec3 point, vec3 direction) {
    uint kind = lightKind(light);
#define PDF(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return pdf##name(light, point, direction);
    LIGHT_KINDS(PDF)
#undef PDF
    return 0.0;
}

// Radiance of a ray that hits the light.
vec3 lightRadiance(Light light) {
    uint kind = lightKind(light);
#define RADIANCE(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return radiance##name(light);
    LIGHT_KINDS(RADIANCE)
#undef RADIANCE
    return vec3(0.0);
}

// u for previews, in place of random numbers.
vec2 lightMiddle(uint kind) {
    vec2 middle = vec2(0.0, 0.5);
#define MIDDLE(number, name, surface) middle = mayHaveLight(number) && kind == number ? kMiddle##name : middle;
    LIGHT_KINDS(MIDDLE)
#undef MIDDLE
    return middle;
}

// Whether BSDF samples may hit the light, so that MIS applies. True for the sky image.
bool isHitByBsdfSamples(uint kind) {
#define FOUND(number, name, surface) && (kBsdfSamplesHit##name || !mayHaveLight(number) || kind != number)
    return true LIGHT_KINDS(FOUND);
#undef FOUND
}

// Whether lights of this kind are area lights, which are shapes too.
bool hasSurface(uint kind) {
#define SURFACE(number, name, surface) || (surface && mayHaveLight(number) && kind == number)
    return false LIGHT_KINDS(SURFACE);
#undef SURFACE
}

#endif
