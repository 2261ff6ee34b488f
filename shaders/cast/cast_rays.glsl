// SPDX-License-Identifier: Apache-2.0
// Shared by the programs for batches of rays: from a row to a ray in the instance's cube. GIVEN: rays are in the
// caller's layout and coordinates.
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

// The row of this lane, NO_INDEX if it has no ray.
uint castRow() {
    uint lane = balancedLane();
    return lane < ofLane(push.rays) ? rowOfLane(lane) : NO_INDEX;
}

// GIVEN: rays are already in the cube.
TraceRay instanceRay(CastRay ray) {
#ifdef GIVEN
    return TraceRay(ray.origin, ray.direction, 0.0, ray.t_max, vec3(0.0), 0.0);
#else
    return TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, ray.t_max * cubeScale(), vec3(0.0), 0.0);
#endif
}

// Cube units per unit of a ray's t.
float unitsInCube() {
#ifdef GIVEN
    return 1.0;
#else
    return cubeScale();
#endif
}

#endif
