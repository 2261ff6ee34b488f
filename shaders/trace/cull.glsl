// SPDX-License-Identifier: Apache-2.0
// Instance culling: loads each ray of a list once and tests it against the boxes of a cull group, so that each instance
// is intersected only with the rays that enter its box. Stores the cull mask of each ray and counts the entries per
// instance; then prepare allocates the culled lists and compact fills them.
#ifndef POINTRT_SHADERS_CULL_GLSL
#define POINTRT_SHADERS_CULL_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/spec_constants.h"
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require

// Number of boxes tested, the first ones of the group.
layout(constant_id = SPEC_CULL_BOXES) const uint kCullBoxes = CULL_INSTANCES;

// A ray in steps of the boxes' frame. It reaches a coordinate along an axis at t = coordinate * inverse + start.
struct CullRay {
    vec3 inverse;
    vec3 start;
    vec3 widths; // |inverse|
    vec3 grown;  // widens boxes by the rounding error of this ray
    float t_max;
};

vec3 toCullFrame(vec3 v) { return vec3(dot(cull.row_x.xyz, v), dot(cull.row_y.xyz, v), dot(cull.row_z.xyz, v)); }

CullRay cullRay(vec3 origin, vec3 direction, float t_max) {
    vec3 at = toCullFrame(origin), way = toCullFrame(direction), moved = vec3(cull.row_x.w, cull.row_y.w, cull.row_z.w);
    // a component of 0 would give NaN products
    vec3 inverse = 1.0 / mix(way, vec3(1e-20), lessThan(abs(way), vec3(1e-20)));
    vec3 widths = abs(inverse);
    return CullRay(inverse, -(at + moved) * inverse, widths, CULL_ROUNDING * largest(abs(at)) * widths, t_max);
}

vec3 inSteps(uint word) {
    return vec3(ivec3(uvec3(word, word >> CULL_BITS, word >> 2u * CULL_BITS) & CULL_STEPS));
}

// Does not use min and max, which on lavapipe also test for NaN.
bool hitsBox(CullRay ray, uint middle, uint half_edges) {
    vec3 t = inSteps(middle) * ray.inverse + ray.start, width = inSteps(half_edges) * ray.widths + ray.grown;
    vec3 near = t - width, far = t + width;
    float first = near.x > near.y ? near.x : near.y, last = far.x < far.y ? far.x : far.y;
    first = first > near.z ? first : near.z;
    last = last < far.z ? last : far.z;
    first = first > 0.0 ? first : 0.0;
    last = last < ray.t_max ? last : ray.t_max;
    return first <= last;
}

// Unrolled by macros: lavapipe loads at constant indices once for all lanes, but otherwise for each lane separately.
#define TEST_ONE(k, box) mask |= k < kCullBoxes && hitsBox(ray, box.x, box.y) ? 1u << (k) : 0u;
#define TEST_TWO(k) TEST_ONE(k, cull.boxes[(k) / 2u].xy) TEST_ONE(k + 1u, cull.boxes[(k) / 2u].zw)
#define TEST_FOUR(k) TEST_TWO(k) TEST_TWO(k + 2u)
#define TEST_EIGHT(k) TEST_FOUR(k) TEST_FOUR(k + 4u)

// Cull mask of a ray: a bit for each instance whose box it enters before t_max.
uint cullMask(CullRay ray) {
    uint mask = 0u;
    TEST_EIGHT(0u)
    TEST_EIGHT(8u)
    TEST_EIGHT(16u)
    TEST_EIGHT(24u)
    return mask & cull.instances.x;
}

// Culls the ray of this lane's entry in the input list. Lanes that are not live take part with an empty mask.
void cullEntry(uint lane, bool live, vec3 origin, vec3 direction, float t_max) {
    uint mask = live ? cullMask(cullRay(origin, direction, t_max)) : 0u;
    if (live) queues[cullMaskStart() + lane] = mask;
    uint left = subgroupOr(mask);
    do {
        uint instance_bit = left != 0u ? uint(findLSB(left)) : 0u;
        uint count = subgroupBallotBitCount(subgroupBallot((mask >> instance_bit & 1u) != 0u));
        if (subgroupElect() && count > 0u) atomicAdd(control.lists[LIST_CULLED + instance_bit].appended, count);
        left &= left - 1u;
    } while (left != 0u);
}

#endif
