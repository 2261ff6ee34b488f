// SPDX-License-Identifier: Apache-2.0
// Traces the queued rays: a whole program but for its version. ANY_HIT, see trace.glsl.
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "trace.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint path = queuedIndex(balancedLane());
    if (path == NO_INDEX) return;
    vec4 origin = loadPathTexel(path, PATH_ORIGIN);
    storeHit(path, trace(TraceRay(origin.xyz, loadPathTexel(path, PATH_DIRECTION).xyz, 0.0, 1e30,
                                  loadPathTexel(path, PATH_LEFT_NORMAL).xyz, origin.w)));
}
