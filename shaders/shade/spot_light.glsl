// SPDX-License-Identifier: Apache-2.0
// Spot light: a point light restricted to a cone with a soft edge.
#ifndef POINTRT_SHADERS_SPOT_LIGHT_GLSL
#define POINTRT_SHADERS_SPOT_LIGHT_GLSL
#include "shaders/shade/point_light.glsl"

const vec2 kMiddleSpot = vec2(0.0, 0.5);
const bool kBsdfSamplesHitSpot = false;

LightSample sampleSpot(Light light, vec3 point, vec2 u) {
    LightSample to = samplePoint(light, point, u);
    float cosine = -dot(to.direction, light.axis.xyz);
    to.radiance_over_pdf *= spotFalloff(cosine, SPOT_OUTER_COSINE(light), SPOT_INNER_COSINE(light));
    return to;
}

float pdfSpot(Light light, vec3 point, vec3 direction) { return 0.0; }
vec3 radianceSpot(Light light) { return vec3(0.0); }

#endif
