// SPDX-License-Identifier: Apache-2.0
// Spherical area light, sampled by the cone that it subtends.
#ifndef POINTRT_SHADERS_SPHERE_LIGHT_GLSL
#define POINTRT_SHADERS_SPHERE_LIGHT_GLSL
#include "shaders/shade/light_sample.glsl"

const vec2 kMiddleSphere = vec2(0.0, 0.5);
const bool kBsdfSamplesHitSphere = true;

// 1 minus the cosine of the half angle of the cone that a sphere subtends; inside the sphere, the cone of all
// directions. Pharr, Jakob and Humphreys, Physically Based Rendering, 6.2.4, in a form without cancellation at a
// distance.
float sphereCap(float squared_distance, float radius) {
    float squared_sine = radius * radius / max(squared_distance, 1e-30);
    return squared_sine < 1.0 ? squared_sine / (1.0 + sqrt(1.0 - squared_sine)) : 2.0;
}

LightSample sampleSphere(Light light, vec3 point, vec2 u) {
    vec3 way = light.position.xyz - point;
    float squared = dot(way, way), radius = SPHERE_RADIUS(light);
    float cap = sphereCap(squared, radius);
    vec3 axis = squared > 0.0 ? way * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
    float from_axis = cap * u.x;
    vec3 direction = coneDirection(axis, from_axis, u.y);
    float middle = sqrt(squared) * (1.0 - from_axis);
    float squared_height = squared * from_axis * (2.0 - from_axis);
    float half_chord = sqrt(max(radius * radius - squared_height, 0.0));
    float distance = max(squared > radius * radius ? middle - half_chord : middle + half_chord, 0.0);
    return LightSample(direction, distance, light.power.xyz * (2.0 * kPi * cap), 1.0 / (2.0 * kPi * cap));
}

float pdfSphere(Light light, vec3 point, vec3 direction) {
    vec3 way = light.position.xyz - point;
    return 1.0 / (2.0 * kPi * sphereCap(dot(way, way), SPHERE_RADIUS(light)));
}

vec3 radianceSphere(Light light) { return light.power.xyz; }

#endif
