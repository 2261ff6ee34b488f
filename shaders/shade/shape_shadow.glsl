// SPDX-License-Identifier: Apache-2.0
// Occlusion of light samples by shapes.
#ifndef POINTRT_SHADERS_SHAPE_SHADOW_GLSL
#define POINTRT_SHADERS_SHAPE_SHADOW_GLSL
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/shape_hit.glsl"

// Whether the first shape on the way to a light occludes the light. An area light is not occluded by its own shape,
// although the distances of light and shape differ by rounding.
bool occludes(ShapeHit hit, LightRay ray) {
    return hit.shape != shapeOfLight(ray.light) && hit.t < ray.to.distance * kBeforeLight;
}

#endif
