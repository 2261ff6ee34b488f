// SPDX-License-Identifier: Apache-2.0
// What the programs for batches of rays share: the way from a row to a ray in the instance's cube. GIVEN: rays are as
// callers have them.
#ifndef POINTRT_SHADERS_CAST_RAYS_GLSL
#define POINTRT_SHADERS_CAST_RAYS_GLSL
#include "shaders/lib/instance_bindings.glsl"
#include "shaders/lib/balanced_lane.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#ifdef GIVEN
#include "shaders/cast/given_rays.glsl"
#else
#include "shaders/cast/packed_rays.glsl"
#endif

// Of this lane; NO_INDEX where there is no ray for it.
uint castRow() {
    uint lane = balancedLane();
    return lane < ofLane(push.rays) ? rowOfLane(lane) : NO_INDEX;
}

// GIVEN: rays are in it already.
TraceRay instanceRay(CastRay ray) {
#ifdef GIVEN
    return TraceRay(ray.origin, ray.direction, 0.0, ray.t_max, vec3(0.0), 0.0);
#else
    return TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, ray.t_max * cubeScale(), vec3(0.0), 0.0);
#endif
}

float unitsInCube() {
#ifdef GIVEN
    return 1.0;
#else
    return cubeScale();
#endif
}

#endif
