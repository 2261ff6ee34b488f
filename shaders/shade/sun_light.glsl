// SPDX-License-Identifier: Apache-2.0
// The sun: a disc at infinity, or a direction if its angular radius is 0.
#ifndef POINTRT_SHADERS_SUN_LIGHT_GLSL
#define POINTRT_SHADERS_SUN_LIGHT_GLSL
#include "shaders/shade/light_sample.glsl"

const vec2 kMiddleSun = vec2(0.0, 0.5);
// Only delta paths (mirrors, glass) see its disc: BSDF samples would rarely hit it.
const bool kBsdfSamplesHitSun = false;

// 1 minus the cosine of its angular radius, an exact subtraction for cosines near 1.
float sunCap(Light light) { return 1.0 - SUN_COSINE(light); }

float pdfSun(Light light, vec3 point, vec3 direction) {
    float cap = sunCap(light);
    return cap > 0.0 ? 1.0 / (2.0 * kPi * cap) : 0.0;
}

// A disc of constant radiance L gives an irradiance of L pi sin^2(angular radius) to a surface facing its centre.
vec3 radianceSun(Light light) {
    float cap = sunCap(light);
    return cap > 0.0 ? light.power.xyz / (kPi * cap * (2.0 - cap)) : vec3(0.0);
}

// Whether an escaped ray hits the disc of the sun. Compares sines, which are precise at small angles.
bool hitsSun(Light light, vec3 direction) {
    vec3 across = cross(direction, light.axis.xyz);
    float cap = sunCap(light);
    return dot(across, across) < cap * (2.0 - cap) && dot(direction, light.axis.xyz) > 0.0;
}

LightSample sampleSun(Light light, vec3 point, vec2 u) {
    float cap = sunCap(light);
    // radiance over pdf, the cap cancelled
    vec3 direction = coneDirection(light.axis.xyz, cap * u.x, u.y);
    return LightSample(direction, kLightAfar, light.power.xyz * (2.0 / (2.0 - cap)), pdfSun(light, point, direction));
}

#endif
