// SPDX-License-Identifier: Apache-2.0
// The GGX lobe of rough boundaries, with height-correlated Smith shadowing (Heitz 2014).
//
// The program defines loadGgxAlbedo(i): entry i of the table of runtime/device_scene/ggx_albedo.h, as vec2(lost,
// grazing).
#ifndef POINTRT_SHADERS_GGX_GLSL
#define POINTRT_SHADERS_GGX_GLSL

#include "shaders/shared/ggx_table.h"
#include "shaders/lib/math.glsl"

// Row of the table for a roughness. alpha is the square of the roughness.
float ggxRow(float roughness) {
    return clamp((roughness - GGX_MIN_ROUGHNESS) / (1.0 - GGX_MIN_ROUGHNESS), 0.0, 1.0) * (GGX_TABLE_SIDE - 1);
}

// Table entry (lost, grazing) for light that leaves at this cosine.
vec2 ggxAlbedo(float row, float cosine) {
    float column = sqrt(clamp(cosine, 0.0, 1.0)) * (GGX_TABLE_SIDE - 1);
    int x = min(int(column), GGX_TABLE_SIDE - 2), y = min(int(row), GGX_TABLE_SIDE - 2);
    int entry = y * GGX_TABLE_SIDE + x;
    vec2 along = vec2(column - x, row - y);
    vec2 lower = mix(loadGgxAlbedo(entry), loadGgxAlbedo(entry + 1), along.x);
    vec2 upper = mix(loadGgxAlbedo(entry + GGX_TABLE_SIDE), loadGgxAlbedo(entry + GGX_TABLE_SIDE + 1), along.x);
    return mix(lower, upper, along.y);
}

// Cosine-weighted mean of the entry over all directions.
vec2 ggxMeanAlbedo(float row) {
    int y = min(int(row), GGX_TABLE_SIDE - 2), entry = GGX_TABLE_SIDE * GGX_TABLE_SIDE + y;
    return mix(loadGgxAlbedo(entry), loadGgxAlbedo(entry + 1), row - y);
}

// The lobe for a pair of directions, without its Fresnel term.
struct GgxLobe {
    float facing; // cosine between wo and the half vector
    float value;  // lobe * dot(n, wi)
    float pdf;    // of glossy directions by ggxOrCosineSample, over solid angle
};

// Both cosines, of wo and wi with n, must be above 0. The sine of the half vector's angle to n is computed by a cross
// product: 1 - cosine^2 would cancel for narrow lobes.
GgxLobe ggxLobe(float alpha, vec3 n, vec3 wo, vec3 wi, float cosine_o, float cosine_i) {
    vec3 half_way = wo + wi, across = cross(n, half_way);
    float length2 = max(dot(half_way, half_way), 1e-12), along = dot(n, half_way);
    float alpha2 = alpha * alpha;
    // mathematically at least alpha2, except if wi = -wo, which has no half vector
    float spread = max((dot(across, across) + alpha2 * along * along) / length2, alpha2);
    float distribution = alpha2 / (kPi * spread * spread);
    float smith_o = sqrt(alpha2 + (1.0 - alpha2) * cosine_o * cosine_o);
    float smith_i = sqrt(alpha2 + (1.0 - alpha2) * cosine_i * cosine_i);
    float value = distribution * 0.5 * cosine_i / (cosine_o * smith_i + cosine_i * smith_o);
    return GgxLobe(dot(wo, half_way) * inversesqrt(length2), value, distribution * 0.5 / (cosine_o + smith_o));
}

// Draws a direction in the frame of the normal. glossy: wo reflected at a visible facet (Dupuy and Benyoub, Sampling
// Visible GGX Normals with Spherical Caps, 2023); may lie below the surface. Otherwise cosine-weighted: the same draw
// with facets seen from straight above, returning the facet.
vec3 ggxOrCosineSample(bool glossy, float alpha, vec3 wo, vec2 u) {
    vec3 axis = glossy ? normalize(vec3(alpha * wo.xy, max(wo.z, 1e-6))) : vec3(0.0, 0.0, 1.0);
    float height = 1.0 - u.y * (1.0 + axis.z), ring = sqrt(max(0.0, 1.0 - height * height)), angle = 2.0 * kPi * u.x;
    vec3 facet = axis + vec3(ring * cos(angle), ring * sin(angle), height);
    facet = normalize(vec3((glossy ? alpha : 1.0) * facet.xy, max(facet.z, 1e-7)));
    return glossy ? 2.0 * dot(wo, facet) * facet - wo : facet;
}

#endif
