// SPDX-License-Identifier: Apache-2.0
// Evaluates shapes.glsl for each ray: with a single shape, and with all shapes.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/scene_layout.h"

layout(local_size_x = 64) in;

struct Query {
    vec4 origin;    // w: t_min
    vec4 direction; // w: number of the single shape
};
struct Answer {
    vec4 normal; // of the single shape; w: its t
    uvec4 hit;   // x: 1 on the back, y: nearest of all shapes, z: nearest visible one, w: t of the nearest as bits
};

layout(push_constant) uniform Push { uvec4 counts; } push; // x: queries, y: shapes
layout(std430, binding = 0) readonly buffer Shapes { Shape shapes[]; };
layout(std430, binding = 1) readonly buffer Queries { Query queries[]; };
layout(std430, binding = 2) writeonly buffer Answers { Answer answers[]; };

#define loadShape(i) shapes[i]
#include "shaders/trace/shapes.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.counts.x) return;
    const vec3 origin = queries[i].origin.xyz, direction = queries[i].direction.xyz;
    const float t_min = queries[i].origin.w;
    const Shape shape = shapes[uint(queries[i].direction.w)];
    const float t = hitShape(shape, origin, direction, t_min);
    bool back;
    answers[i].normal = vec4(shapeNormal(shape, origin + t * direction, direction, back), t);
    const ShapeHit all = nearestShape(push.counts.y, origin, direction, t_min);
    const ShapeHit seen = nearestSeenShape(push.counts.y, origin, direction, t_min);
    answers[i].hit = uvec4(back ? 1u : 0u, all.shape, seen.shape, floatBitsToUint(all.t));
}
