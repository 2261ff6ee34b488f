// SPDX-License-Identifier: Apache-2.0
// What asking a light from a point gives, and what the kinds of light need for it.
#ifndef POINTRT_SHADERS_LIGHT_SAMPLE_GLSL
#define POINTRT_SHADERS_LIGHT_SAMPLE_GLSL
#include "shaders/lib/basis.glsl"
#include "shaders/lib/math.glsl"
#include "shaders/shared/light_layout.h"

// To what is not at a distance: the sun.
const float kLightAfar = 1e30;
// Densities end here, where their squares are still finite: a quad seen from its own plane has no solid angle.
const float kHighestPdf = 1e15;

struct LightSample {
    vec3 direction;          // to the light
    float distance;          // to the lamp's surface, where a shadow ray ends
    vec3 radiance_over_pdf;  // what the sample adds to the irradiance of a surface that faces it, were nothing between
    float pdf;               // of the direction, over solid angle; 0: the light has no extent and no ray can meet it
};

// The arc of (x, y), y not negative: 0 to pi, with an error of 3e-7. Vulkan lets atan be off by 4096 units in the last
// place, and solid angles are differences of arcs. Polynomial: Cephes, atanf.
float arcOf(float x, float y) {
    float width = abs(x);
    // turned so that the quotient is at most tan(pi / 8)
    bool steep = y > 2.414213562 * width, middle = !steep && y > 0.414213562 * width;
    float above = steep ? -width : (middle ? y - width : y), below = steep ? y : (middle ? y + width : width);
    float q = below > 0.0 ? above / below : 0.0, s = q * q;
    float series = (((0.0805374449538 * s - 0.138776856032) * s + 0.199777106478) * s - 0.333329491539) * s * q + q;
    float arc = series + (steep ? 0.5 * kPi : (middle ? 0.25 * kPi : 0.0));
    return x < 0.0 ? kPi - arc : arc;
}

// The direction whose angle with axis has a cosine of 1 - from_axis, at turn u (of 1) around it.
vec3 coneDirection(vec3 axis, float from_axis, float u) {
    float sine = sqrt(max(from_axis * (2.0 - from_axis), 0.0)), turn = 2.0 * kPi * u;
    return normalize(frameAround(axis) * vec3(sine * cos(turn), sine * sin(turn), 1.0 - from_axis));
}

#endif
