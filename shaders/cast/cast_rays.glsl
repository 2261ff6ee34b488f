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
layout(rgba32ui, binding = BINDING_CAST_HITS) uniform writeonly uimageBuffer cast_hit_texels; // CastHit, t as bits
layout(r32ui, binding = BINDING_CAST_STOPPED) uniform writeonly uimageBuffer cast_stopped; // 0: it is not
layout(push_constant) uniform Push { CastPush push; };

// Of this lane; NO_INDEX where there is no ray for it.
uint castRow() {
    uint lane = balancedLane();
    return lane < ofLane(push.rays) ? push.first + lane : NO_INDEX;
}

// A row as it stands, in render space.
CastRay loadCastRay(uint row) {
    vec4 origin = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS));
    vec4 direction = uintBitsToFloat(imageLoad(cast_ray_texels, int(row) * CAST_RAY_VECTORS + 1));
    return CastRay(origin.xyz, origin.w, direction.xyz, 0.0);
}

void storeCastHit(uint row, CastHit hit) {
    imageStore(cast_hit_texels, int(row), uvec4(floatBitsToUint(hit.t), hit.splat, hit.normal, 0u));
}

TraceRay instanceRay(CastRay ray) {
    return TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, ray.t_max * cubeScale(), vec3(0.0), 0.0);
}

#endif
