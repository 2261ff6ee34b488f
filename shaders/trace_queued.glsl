// SPDX-License-Identifier: Apache-2.0
// Traces the queued rays through one instance: a whole program but for its version. ANY_HIT, see trace.glsl.
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint path = queuedIndex(balancedLane());
    if (path == NO_INDEX) return;
    vec4 origin = loadPathTexel(path, PATH_ORIGIN), left = loadPathTexel(path, PATH_LEFT_NORMAL);
    bool own = floatBitsToUint(left.w) >> PATH_OWNER_SHIFT == instance.materials.x;
    storeHit(path, trace(TraceRay(cubePoint(origin.xyz), cubeDirection(loadPathTexel(path, PATH_DIRECTION).xyz), 0.0,
                                  reachOf(path), cubeDirection(left.xyz), own ? origin.w * cubeScale() : 0.0)));
}
