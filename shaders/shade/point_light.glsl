// SPDX-License-Identifier: Apache-2.0
// Isotropic point light.
#ifndef POINTRT_SHADERS_POINT_LIGHT_GLSL
#define POINTRT_SHADERS_POINT_LIGHT_GLSL
#include "shaders/shade/light_sample.glsl"

const vec2 kMiddlePoint = vec2(0.0, 0.5);
const bool kBsdfSamplesHitPoint = false;

LightSample samplePoint(Light light, vec3 point, vec2 u) {
    vec3 way = light.position.xyz - point;
    float squared = max(dot(way, way), 1e-30);
    return LightSample(way * inversesqrt(squared), sqrt(squared), light.power.xyz / squared, 0.0);
}

float pdfPoint(Light light, vec3 point, vec3 direction) { return 0.0; }
vec3 radiancePoint(Light light) { return vec3(0.0); }

#endif
