// SPDX-License-Identifier: Apache-2.0
// Shadow rays and the shapes.
#ifndef POINTRT_SHADERS_SHAPE_SHADOW_GLSL
#define POINTRT_SHADERS_SHAPE_SHADOW_GLSL
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/shapes.glsl"

// Whether the first shape on the way to a light hides it. A lamp is not hidden by itself: its distance from here and as
// a shape differ by rounding.
bool hides(ShapeHit hit, LightSample to, Light light) {
    return hit.shape != lampOf(light) && hit.t < to.distance * kBeforeLamp;
}

#endif
