// SPDX-License-Identifier: Apache-2.0
// Decoding of splats, after pro_layout.h.

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

float splatRadius(uvec4 words) {
    return params.splat.x * exp2(-float(words.w >> PRO_RADIUS_SHIFT) * params.splat.y);
}

vec3 splatColor(uvec4 words) { return unpackUnorm4x8(words.w & PRO_COLOR_MASK).rgb; }

uint splatMaterial(uvec4 words) { return words.z >> PRO_MATERIAL_SHIFT; }

// Lengths of a cell's list: what rays can hit, and all that blends.
uint hittableCount(uvec4 cell) { return cell[CELL_COUNTS] & CELL_COUNT_MASK; }
uint blendingCount(uvec4 cell) { return hittableCount(cell) + (cell[CELL_COUNTS] >> CELL_COUNT_SHIFT); }
