// SPDX-License-Identifier: Apache-2.0
// The part of a ray on which the scene's clips keep an instance. Clips keep an intersection of half-spaces, so this
// part is a single interval. The walk starts and ends with the interval, and hits outside it do not count.
#ifndef POINTRT_SHADERS_CLIP_GLSL
#define POINTRT_SHADERS_CLIP_GLSL
#include "shaders/trace/instance.glsl"

// Ends of an interval without bounds: beyond the t of all hits.
const float kUnclipped = 3e38;

// Distances along the ray, cube units: where it enters the kept part, and where it leaves it. Empty if the first is
// larger.
vec2 keptInterval(vec3 origin, vec3 direction) {
    vec2 kept = vec2(-kUnclipped, kUnclipped);
    uint planes = ofLane(instance.grid_words.w);
    for (uint i = 0u; i < planes; i++) {
        vec4 plane = loadClipPlane(i);
        float slope = dot(plane.xyz, direction), height = plane.w - dot(plane.xyz, origin);
        // for a ray parallel to the plane, t is far before everything if the ray lies inside, and far behind everything
        // if the ray lies outside
        float t = height / (slope == 0.0 ? 1e-20 : slope);
        kept.x = slope >= 0.0 && t > kept.x ? t : kept.x;
        kept.y = slope < 0.0 && t < kept.y ? t : kept.y;
    }
    return kept;
}

#endif
