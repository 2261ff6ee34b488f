// SPDX-License-Identifier: Apache-2.0
// Hits of shapes between rays and what is kept of them.
#ifndef POINTRT_SHADERS_SHAPE_HIT_GLSL
#define POINTRT_SHADERS_SHAPE_HIT_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/trace/shapes.glsl"
#include "shaders/trace/offset.glsl"

// Nearer hits of shapes do not count for a ray that starts here, and has left what this owner has.
float nearestFrom(uint owner, vec3 origin) { return owner == OWNER_SHAPES ? ownShapeReach(origin) : 0.0; }

// As hits are kept; kNoHit where there is none.
uvec4 hitWords(ShapeHit hit) {
    return hit.t >= kNoShapeHit ? kNoHit : uvec4(floatBitsToUint(hit.t), 0u, hit.shape, OWNER_SHAPES);
}

#endif
