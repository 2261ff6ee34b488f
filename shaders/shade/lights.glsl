// SPDX-License-Identifier: Apache-2.0
// Lights seen from a point: directions to send shadow rays in, and the densities of those directions, by which they are
// weighed against scattered rays that meet a lamp. The sky is sampled elsewhere (LIGHT_SKY has no directions here).
// Points, normals and distances in render units; directions are unit vectors.
//
// Each kind NAME of LIGHT_KINDS (shaders/shared/light_layout.h) has a file with all of these; to lack one is an error:
//   LightSample sampleNAME(Light light, vec3 point, vec2 u)    as sampleLight, of that kind; likewise
//   float pdfNAME(Light light, vec3 point, vec3 direction)     as lightPdf, and
//   vec3 radianceNAME(Light light)                             as lightRadiance
//   const vec2 kMiddleNAME                                     u of the direction that stands for all of it
//   const bool kFoundByChanceNAME                              whether scattered rays bring its light, met by chance
#ifndef POINTRT_SHADERS_LIGHTS_GLSL
#define POINTRT_SHADERS_LIGHTS_GLSL

#include "shaders/shade/disc_light.glsl"
#include "shaders/shade/point_light.glsl"
#include "shaders/shade/quad_light.glsl"
#include "shaders/shade/sphere_light.glsl"
#include "shaders/shade/spot_light.glsl"
#include "shaders/shade/sun_light.glsl"

// A program may say which kinds there are.
#ifndef mayHaveLight
#define mayHaveLight(kind) true
#endif

uint lightKind(Light light) { return uint(LIGHT_KIND(light)); }

// A direction from point to the light, for u in [0, 1)^2. What is behind the surface is for the caller to leave out.
LightSample sampleLight(Light light, vec3 point, vec2 u) {
    uint kind = lightKind(light);
#define SAMPLE(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return sample##name(light, point, u);
    LIGHT_KINDS(SAMPLE)
#undef SAMPLE
    return LightSample(vec3(0.0, 0.0, 1.0), kLightAfar, vec3(0.0), 0.0);
}

// Density with which sampleLight gives a direction that meets the lamp's shape or ends in the sun's disc; 0 for lights
// without extent. Whether it does meet it is not looked at here.
float lightPdf(Light light, vec3 point, vec3 direction) {
    uint kind = lightKind(light);
#define PDF(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return pdf##name(light, point, direction);
    LIGHT_KINDS(PDF)
#undef PDF
    return 0.0;
}

// What a ray sees that meets the lamp.
vec3 lightRadiance(Light light) {
    uint kind = lightKind(light);
#define RADIANCE(number, name, surface) \
    if (mayHaveLight(number) && kind == number) return radiance##name(light);
    LIGHT_KINDS(RADIANCE)
#undef RADIANCE
    return vec3(0.0);
}

// In place of random numbers while things move.
vec2 lightMiddle(uint kind) {
    vec2 middle = vec2(0.0, 0.5);
#define MIDDLE(number, name, surface) middle = mayHaveLight(number) && kind == number ? kMiddle##name : middle;
    LIGHT_KINDS(MIDDLE)
#undef MIDDLE
    return middle;
}

// The sky's image is.
bool isFoundByChance(uint kind) {
#define FOUND(number, name, surface) && (kFoundByChance##name || !mayHaveLight(number) || kind != number)
    return true LIGHT_KINDS(FOUND);
#undef FOUND
}

// Whether it has a surface, which is a shape as well.
bool hasSurface(uint kind) {
#define SURFACE(number, name, surface) || (surface && mayHaveLight(number) && kind == number)
    return false LIGHT_KINDS(SURFACE);
#undef SURFACE
}

#endif
