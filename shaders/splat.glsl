// SPDX-License-Identifier: Apache-2.0
// Decoding of splats, after pro_layout.h.
#ifndef POINTRT_SHADERS_SPLAT_GLSL
#define POINTRT_SHADERS_SPLAT_GLSL

vec3 splatPosition(uvec4 words) {
    uvec3 code = uvec3(words.x & PRO_POSITION_MASK,
                       (words.x >> PRO_POSITION_BITS) | ((words.y & PRO_Y_HIGH_MASK) << PRO_Y_LOW_BITS),
                       (words.y >> PRO_Y_HIGH_BITS) & PRO_POSITION_MASK);
    return (vec3(code) + 0.5) * PRO_POSITION_STEP;
}

// A normal of any length: enough for plane intersection, where length cancels.
vec3 splatDirection(uvec4 words) {
    vec2 uv = vec2(words.z & PRO_NORMAL_MASK, (words.z >> PRO_NORMAL_BITS) & PRO_NORMAL_MASK);
    uv = uv * (2.0 / PRO_NORMAL_STEPS) - 1.0;
    vec3 n = vec3(uv, 1.0 - abs(uv.x) - abs(uv.y));
    float fold = max(-n.z, 0.0);
    n.xy -= vec2(n.x >= 0.0 ? fold : -fold, n.y >= 0.0 ? fold : -fold);
    return n;
}

// coding: instance.splat, loaded before any loop: lavapipe takes its time for each load from a storage buffer.
float splatRadius(uvec4 words, vec4 coding) {
    return coding.x * exp2(-float(words.w >> PRO_RADIUS_SHIFT) * coding.y);
}

vec3 splatColor(uvec4 words) { return unpackUnorm4x8(words.w & PRO_COLOR_MASK).rgb; }

uint splatMaterial(uvec4 words) { return words.z >> PRO_MATERIAL_SHIFT; }

// A traced hit's splat and the distance to its disc.
struct SplatHit {
    uint splat;
    uvec4 words;
    float t;
};

// hit: a TraceHit's words as stored. Its distance is rounded with its near splat (pointrt/pro_index_layout.h), by less than
// a hundredth of a radius unless the ray grazes the disc. The exact one is measured from there, because from a distant
// origin too few bits would be left.
SplatHit exactHit(uvec4 hit, vec3 origin, vec3 direction) {
    uint splat = loadListed(hit.z);
    uvec4 words = loadSplat(splat);
    float t = uintBitsToFloat(hit.x), radius = splatRadius(words, instance.splat);
    vec3 normal = splatDirection(words);
    float correction = dot(normal, splatPosition(words) - (origin + t * direction)) / dot(normal, direction);
    return SplatHit(splat, words, t + clamp(correction, -radius, radius));
}

#endif
