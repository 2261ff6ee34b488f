// SPDX-License-Identifier: Apache-2.0
// The colours with which the integrators normal and depth show a surface, and the shading function of each integrator.
#ifndef POINTRT_SHADERS_SURFACE_VIEW_GLSL
#define POINTRT_SHADERS_SURFACE_VIEW_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/lib/features.glsl"

// The numbers of SHADINGS, and those of all integrators packed into one constant.
#define SHADING_NUMBER(number, NAME, function) const uint SHADING_##NAME = number;
SHADINGS(SHADING_NUMBER)
#define SHADING_OF_ROW(number, Name, word, label, SHADING, traits) | SHADING_##SHADING << (INTEGRATOR_BITS * number)
const uint kShadings = 0u INTEGRATORS(SHADING_OF_ROW);
const uint kShading = kShadings >> (INTEGRATOR_BITS * kIntegrator) & ((1u << INTEGRATOR_BITS) - 1u);

// Linear colours. normal: of unit length
vec3 normalColor(vec3 normal) { return linearFromSrgb(normal * 0.5 + 0.5); }
vec3 depthColor(float t) { return vec3(max(0.0, 1.0 - t / params.depth_black)); }

#endif
