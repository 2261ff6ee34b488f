// SPDX-License-Identifier: Apache-2.0
// A list of rays sifted for targets: a ray is loaded once and held against the boxes that the targets can be hit in, and
// the targets are then asked for those alone that come into theirs. Here their bits are kept and counted;
// prepare makes room for the targets' lists, and place fills them.
#ifndef POINTRT_SHADERS_SIFT_GLSL
#define POINTRT_SHADERS_SIFT_GLSL
#include "shaders/lib/math.glsl"
#include "shaders/shared/spec_constants.h"
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require

// Boxes of the sieve that may have targets, the first ones.
layout(constant_id = SPEC_SIEVE_BOXES) const uint kSieveBoxes = SIEVE_TARGETS;

// A ray in a sieve's steps: it comes to a plane across an axis after plane * inverse + start.
struct SiftedRay {
    vec3 inverse;
    vec3 start;
    vec3 widths; // |inverse|
    vec3 grown;  // by so much a box is longer for it, so that rounding takes none away
    float t_max;
};

vec3 turned(vec3 v) { return vec3(dot(sieve.row_x.xyz, v), dot(sieve.row_y.xyz, v), dot(sieve.row_z.xyz, v)); }

SiftedRay siftedRay(vec3 origin, vec3 direction, float t_max) {
    vec3 at = turned(origin), way = turned(direction), moved = vec3(sieve.row_x.w, sieve.row_y.w, sieve.row_z.w);
    // a component of 0 would make products that are no numbers
    vec3 inverse = 1.0 / mix(way, vec3(1e-20), lessThan(abs(way), vec3(1e-20)));
    vec3 widths = abs(inverse);
    return SiftedRay(inverse, -(at + moved) * inverse, widths, SIEVE_ROUNDING * largest(abs(at)) * widths, t_max);
}

vec3 inSteps(uint word) {
    return vec3(ivec3(uvec3(word, word >> SIEVE_BITS, word >> 2u * SIEVE_BITS) & SIEVE_STEPS));
}

// Not by min and max, which on lavapipe look for what is no number.
bool meetsBox(SiftedRay ray, uint middle, uint half_edges) {
    vec3 t = inSteps(middle) * ray.inverse + ray.start, width = inSteps(half_edges) * ray.widths + ray.grown;
    vec3 near = t - width, far = t + width;
    float first = near.x > near.y ? near.x : near.y, last = far.x < far.y ? far.x : far.y;
    first = first > near.z ? first : near.z;
    last = last < far.z ? last : far.z;
    first = first > 0.0 ? first : 0.0;
    last = last < ray.t_max ? last : ray.t_max;
    return first <= last;
}

// Written out: lavapipe loads what a constant number names for all lanes at once, and else for each by itself.
#define MEETS(k, box) met |= k < kSieveBoxes && meetsBox(ray, box.x, box.y) ? 1u << (k) : 0u;
#define MEETS_TWO(k) MEETS(k, sieve.boxes[(k) / 2u].xy) MEETS(k + 1u, sieve.boxes[(k) / 2u].zw)
#define MEETS_FOUR(k) MEETS_TWO(k) MEETS_TWO(k + 2u)
#define MEETS_EIGHT(k) MEETS_FOUR(k) MEETS_FOUR(k + 4u)

// Bits of the targets whose boxes a ray comes into before t_max.
uint targetsMet(SiftedRay ray) {
    uint met = 0u;
    MEETS_EIGHT(0u)
    MEETS_EIGHT(8u)
    MEETS_EIGHT(16u)
    MEETS_EIGHT(24u)
    return met & sieve.targets.x;
}

// The entry of this lane in the list that the program goes by. Lanes that are not live work along.
void sift(uint lane, bool live, vec3 origin, vec3 direction, float t_max) {
    uint met = live ? targetsMet(siftedRay(origin, direction, t_max)) : 0u;
    if (live) queues[sieveBitsStart() + lane] = met;
    uint left = subgroupOr(met);
    do {
        uint target = left != 0u ? uint(findLSB(left)) : 0u;
        uint count = subgroupBallotBitCount(subgroupBallot((met >> target & 1u) != 0u));
        if (subgroupElect() && count > 0u) atomicAdd(control.lists[LIST_SIFTED + target].appended, count);
        left &= left - 1u;
    } while (left != 0u);
}

#endif
