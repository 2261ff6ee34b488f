// SPDX-License-Identifier: Apache-2.0
// A sample of a light as seen from a point, and helpers of the kinds of light.
#ifndef POINTRT_SHADERS_LIGHT_SAMPLE_GLSL
#define POINTRT_SHADERS_LIGHT_SAMPLE_GLSL
#include "shaders/lib/basis.glsl"
#include "shaders/lib/math.glsl"
#include "shaders/shared/light_layout.h"

// Distance to the sun and the sky.
const float kLightAfar = 1e30;
// Upper limit of densities, since a quad seen edge-on has no solid angle. Its square is still finite.
const float kHighestPdf = 1e15;

struct LightSample {
    vec3 direction;         // to the light
    float distance;         // to the surface of the light, where a shadow ray ends
    vec3 radiance_over_pdf; // unoccluded contribution to the irradiance of a surface facing the light
    float pdf;              // of the direction, over solid angle; 0: a delta light, which no ray can hit
};

// Angle of (x, y) for y >= 0, 0 to pi, with an error of 3e-7. Vulkan allows atan an error of 4096 units in the last
// place, too much for solid angles, which are differences of angles. Polynomial: Cephes, atanf.
float arcOf(float x, float y) {
    float width = abs(x);
    // rotated so that the quotient is at most tan(pi / 8)
    bool steep = y > 2.414213562 * width, middle = !steep && y > 0.414213562 * width;
    float above = steep ? -width : (middle ? y - width : y), below = steep ? y : (middle ? y + width : width);
    float q = below > 0.0 ? above / below : 0.0, s = q * q;
    float series = (((0.0805374449538 * s - 0.138776856032) * s + 0.199777106478) * s - 0.333329491539) * s * q + q;
    float arc = series + (steep ? 0.5 * kPi : (middle ? 0.25 * kPi : 0.0));
    return x < 0.0 ? kPi - arc : arc;
}

// Direction whose angle to the axis has the cosine 1 - from_axis, at azimuth 2 pi u around the axis.
vec3 coneDirection(vec3 axis, float from_axis, float u) {
    float sine = sqrt(max(from_axis * (2.0 - from_axis), 0.0)), azimuth = 2.0 * kPi * u;
    return normalize(frameAround(axis) * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - from_axis));
}

#endif
