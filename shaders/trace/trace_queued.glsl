// SPDX-License-Identifier: Apache-2.0
// Traces the queued rays through one instance. ANY_HIT, see trace.glsl.
#include "shaders/frame/bindings.glsl"
#include "shaders/frame/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/frame/append.glsl"
#include "shaders/trace/store_hit.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// live: whether this lane has a ray, that of path; others work along, for lists need the whole subgroup.
TraceHit traceQueued(out uint path, out bool live) {
    uint lane = balancedLane();
    path = hasStep(STEP_FRESH) ? queuedIndex(lane) : askedEntry(lane);
    live = path != NO_INDEX;
    path = live ? path : 0u;
    vec4 origin = loadPathTexel(path, PATH_ORIGIN), left = loadPathTexel(path, PATH_LEFT_NORMAL);
    bool own = floatBitsToUint(left.w) >> PATH_OWNER_SHIFT == instance.materials.x;
    return trace(TraceRay(cubePoint(origin.xyz), cubeDirection(loadPathTexel(path, PATH_DIRECTION).xyz), 0.0,
                          live ? reachOf(path) : -1.0, cubeDirection(left.xyz), own ? origin.w * cubeScale() : 0.0));
}
