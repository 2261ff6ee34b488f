// SPDX-License-Identifier: Apache-2.0
// First hits as points of the cache.
#ifndef POINTRT_SHADERS_HIT_POINT_GLSL
#define POINTRT_SHADERS_HIT_POINT_GLSL
#include "shaders/display/point_cache.glsl"
#include "shaders/shared/film_parts.h"

// View dependence from which a pixel counts as a mirror.
const float kMirrorThreshold = 0.05;

struct HitPoint {
    vec3 position; // for the sky, a direction
    uint info;
    float depth;
};

// The hit of the ray through a pixel's centre, stored at this index; without samples.
HitPoint hitPoint(uvec2 place, uint index) {
    vec4 hit = first_hits[FIRST_HIT_VECTORS * index], ids = first_hits[FIRST_HIT_VECTORS * index + 1u];
    vec3 direction = rayDirection(place);
    uint info = (params.frame & POINT_FRAME_MASK) | (ids.w > kMirrorThreshold ? POINT_VIEW_DEPENDENT : 0u);
    if (hit.w < 0.0) return HitPoint(direction, info | POINT_IS_SKY, kSkyDepth);
    float steps = hit.w / length(direction);
    bool on_shape = floatBitsToUint(ids[HIT_OWNER]) == OWNER_SHAPES;
    return HitPoint(rayOrigin(place) + steps * direction, info | (on_shape ? POINT_ON_SHAPE : 0u), steps);
}

#endif
