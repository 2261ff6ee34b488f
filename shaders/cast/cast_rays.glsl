// SPDX-License-Identifier: Apache-2.0
// What the programs for batches of rays share: their buffers, and the way from a row to a ray in the instance's cube.
#ifndef POINTRT_SHADERS_CAST_RAYS_GLSL
#define POINTRT_SHADERS_CAST_RAYS_GLSL
#include "shaders/frame/instance_bindings.glsl"
#include "shaders/frame/balanced_lane.glsl"
#include "shaders/shared/cast_layout.h"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

layout(rgba32ui, binding = BINDING_CAST_RAYS) uniform readonly uimageBuffer cast_ray_texels; // CastRay
layout(rgba32ui, binding = BINDING_CAST_HITS) uniform uimageBuffer cast_hit_texels; // CastHit, t as bits
layout(r32ui, binding = BINDING_CAST_STOPPED) uniform uimageBuffer cast_stopped;    // 0: it is not
layout(push_constant) uniform Push { CastPush push; };

bool isFirstInstance() { return ofLane(push.place) == 0u; }

// A row as it stands, in render space.
CastRay loadCastRay(uint row) {
    vec4 origin = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS));
    vec4 direction = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS + 1));
    return CastRay(origin.xyz, origin.w, direction.xyz, 0.0);
}

CastHit loadCastHit(uint row) {
    uvec4 words = imageLoad(cast_hit_texels, int(row));
    return CastHit(uintBitsToFloat(words.x), words.y, words.z, words.w);
}

void storeCastHit(uint row, CastHit hit) {
    imageStore(cast_hit_texels, int(row), uvec4(floatBitsToUint(hit.t), hit.splat, hit.place, hit.normal));
}

// Up to t_max, in render units.
TraceRay instanceRay(CastRay ray, float t_max) {
    return TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, t_max * cubeScale(), vec3(0.0), 0.0);
}

#endif
