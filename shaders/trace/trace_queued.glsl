// SPDX-License-Identifier: Apache-2.0
// Traces the rays listed for instances through one of them. ANY_HIT, see trace.glsl.
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

// Up to t_max, in cube units.
TraceHit tracePath(uint path, float t_max) {
    uvec4 origin = loadPathTexel(path, PATH_ORIGIN), left = loadPathTexel(path, PATH_LEFT_NORMAL);
    bool own = left.w >> PATH_OWNER_SHIFT == instance.materials.x;
    return trace(TraceRay(cubePoint(asVector(origin)), cubeDirection(asVector(loadPathTexel(path, PATH_DIRECTION))), 0.0,
                          t_max, cubeDirection(asVector(left)), own ? asFloat(origin.w) * cubeScale() : 0.0));
}
