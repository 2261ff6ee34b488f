// SPDX-License-Identifier: Apache-2.0
// Whether one instance stands in the way of a batch of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/cast/cast_rays.glsl"

void main() {
    uint row = balancedLane();
    if (row >= ofLane(push.rays)) return;
    CastRay ray = loadCastRay(row);
    uint stopped = 0u;
    if (!isFirstInstance()) stopped = imageLoad(cast_stopped, int(row)).x;
    bool hits = trace(instanceRay(ray, stopped == 0u ? ray.t_max : -1.0)).disc != NO_INDEX;
    imageStore(cast_stopped, int(row), uvec4(hits ? 1u : stopped));
}
