// SPDX-License-Identifier: Apache-2.0
// Rays that the host has transformed to render space, each with its own t_max, and hits in render units.
#ifndef POINTRT_SHADERS_PACKED_RAYS_GLSL
#define POINTRT_SHADERS_PACKED_RAYS_GLSL
#include "shaders/cast/cast_bindings.glsl"

layout(rgba32ui, binding = BINDING_CAST_HITS) uniform writeonly uimageBuffer cast_hit_texels; // CastHit
layout(push_constant) uniform Push { CastPush push; };

uint rowOfLane(uint lane) { return push.first + lane; }

struct LoadedRay {
    CastRay ray;
};

LoadedRay loadRay(uint row) {
    vec4 origin = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS));
    vec4 direction = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS + 1));
    return LoadedRay(CastRay(origin.xyz, origin.w, direction.xyz, 0.0));
}

// t: render units; splat: NO_INDEX for a miss.
void storeHit(uint row, LoadedRay loaded, float t, uint splat, uint normal) {
    imageStore(cast_hit_texels, int(row), uvec4(floatBitsToUint(t), splat, normal, 0u));
}

void storeStopped(uint row, LoadedRay loaded, bool hits) {
    imageStore(cast_stopped, int(row), uvec4(hits ? 1u : 0u));
}

#endif
