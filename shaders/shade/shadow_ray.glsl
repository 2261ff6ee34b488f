// SPDX-License-Identifier: Apache-2.0
// The megakernel's stored shadow rays.
#ifndef POINTRT_SHADERS_SHADOW_RAY_GLSL
#define POINTRT_SHADERS_SHADOW_RAY_GLSL
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"

ShadowRay loadShadowRay(uint path) {
    uvec4 origin = loadShadowTexel(path, 0), direction = loadShadowTexel(path, 1), left = loadShadowTexel(path, 2),
          light = loadShadowTexel(path, 3);
    return ShadowRay(asVector(origin), asFloat(origin.w), asVector(direction), asFloat(direction.w), asVector(left),
                     left.w, asVector(light), light.w);
}

#endif
