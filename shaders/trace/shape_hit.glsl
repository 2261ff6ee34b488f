// SPDX-License-Identifier: Apache-2.0
// Hits of shapes: self-intersection and storage.
#ifndef POINTRT_SHADERS_SHAPE_HIT_GLSL
#define POINTRT_SHADERS_SHAPE_HIT_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/trace/shapes.glsl"
#include "shaders/trace/offset.glsl"

// Smallest t of hits on shapes for a ray that starts here and has left a surface of this owner: nearer hits are
// self-intersections.
float shapeMinDistance(uint owner, vec3 origin) { return owner == OWNER_SHAPES ? shapeSelfDistance(origin) : 0.0; }

// A hit as stored; kNoHit for a miss.
uvec4 hitWords(ShapeHit hit) {
    return hit.t >= kNoShapeHit ? kNoHit : uvec4(floatBitsToUint(hit.t), 0u, hit.shape, OWNER_SHAPES);
}

#endif
