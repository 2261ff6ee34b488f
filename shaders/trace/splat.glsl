// SPDX-License-Identifier: Apache-2.0
// Decoding of splats (pro_layout.h).
#ifndef POINTRT_SHADERS_SPLAT_GLSL
#define POINTRT_SHADERS_SPLAT_GLSL
#include "shaders/trace/instance.glsl"

// Two vectors: the .x of each component belongs to the first, the .y to the second.
struct VectorPair {
    vec2 x, y, z;
};

vec3 firstOf(VectorPair pair) { return vec3(pair.x.x, pair.y.x, pair.z.x); }
vec2 dots(VectorPair a, VectorPair b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
vec2 dots(VectorPair a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Converted as signed integers: CPUs have one instruction for that.
vec2 floatsOf(uvec2 codes) { return vec2(ivec2(codes)); }

// Positions of two splats.
VectorPair positionCodes(uvec4 a, uvec4 b) {
    uvec2 low = uvec2(a.x, b.x), high = uvec2(a.y, b.y);
    return VectorPair(floatsOf(low & PRO_POSITION_MASK),
                      floatsOf(low >> PRO_POSITION_BITS | (high & PRO_Y_HIGH_MASK) << PRO_Y_LOW_BITS),
                      floatsOf(high >> PRO_Y_HIGH_BITS & PRO_POSITION_MASK));
}

// Normals of two splats, not normalized.
VectorPair normalCodes(uvec4 a, uvec4 b) {
    const float middle = 0.5 * PRO_NORMAL_STEPS;
    uvec2 words = uvec2(a.z, b.z);
    vec2 u = floatsOf(words & PRO_NORMAL_MASK) - middle;
    vec2 v = floatsOf(words >> PRO_NORMAL_BITS & PRO_NORMAL_MASK) - middle;
    vec2 height = middle - abs(u) - abs(v), fold = max(-height, 0.0);
    return VectorPair(u - mix(-fold, fold, greaterThanEqual(u, vec2(0.0))),
                      v - mix(-fold, fold, greaterThanEqual(v, vec2(0.0))), height);
}

vec3 splatPosition(uvec4 words) { return (firstOf(positionCodes(words, words)) + 0.5) * PRO_POSITION_STEP; }

// A normal, not normalized: sufficient for plane intersection, where the length cancels.
vec3 splatDirection(uvec4 words) { return firstOf(normalCodes(words, words)); }

// coding: instance.splat, to be loaded before loops: loads from storage buffers are slow on lavapipe.
float splatRadius(uvec4 words, vec4 coding) {
    return coding.x * exp2(-float(words.w >> PRO_RADIUS_SHIFT) * coding.y);
}

vec3 splatColor(uvec4 words) { return unpackUnorm4x8(words.w & PRO_COLOR_MASK).rgb; }

uint splatMaterial(uvec4 words) { return words.z >> PRO_MATERIAL_SHIFT; }

bool isBall(uvec4 words) { return kHasBalls && (words.y & PRO_SPLAT_BALL) != 0u; }

// Distance to a ball near t along the ray: to where the ray enters the ball, or leaves it if the ray's origin is
// inside; for a near miss, to the point closest to the ball. Unlike the distance to a disc, it is not clamped to a
// radius around t: a grazing ray may enter half a radius away.
float ballDistance(float t, uvec4 words, vec3 origin, vec3 direction) {
    float radius = splatRadius(words, instance.splat), inverse = 1.0 / dot(direction, direction);
    vec3 center = splatPosition(words), start = origin - center, offset = origin + t * direction - center;
    float along = dot(offset, direction) * inverse;
    vec3 across = offset - along * direction;
    float half_chord = sqrt(max(radius * radius - dot(across, across), 0.0) * inverse);
    float t_in = t - along - half_chord, t_out = t - along + half_chord;
    // clips may cut a ball open, so that a ray from outside hits the ball where it leaves it
    bool inside = kClipped ? along > 0.0 : t_in < 0.0 || dot(start, start) < radius * radius;
    return max(inside ? t_out : t_in, 0.0);
}

// Distance to the disc or ball of a traced hit, given as the stored words of the TraceHit and the words of its splat.
// The stored t is that of the quantized cell disc (pointrt/pro_index_layout.h), off by less than a hundredth of a
// radius unless the ray grazes the disc. The exact distance is computed from that point: from a distant origin too few
// bits would be left.
float exactDistance(uvec4 hit, uvec4 words, vec3 origin, vec3 direction) {
    if (isBall(words)) return ballDistance(uintBitsToFloat(hit.x), words, origin, direction);
    float t = uintBitsToFloat(hit.x), radius = splatRadius(words, instance.splat);
    vec3 normal = splatDirection(words);
    float correction = dot(normal, splatPosition(words) - (origin + t * direction)) / dot(normal, direction);
    return t + clamp(correction, -radius, radius);
}

#endif
