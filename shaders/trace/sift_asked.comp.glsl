// SPDX-License-Identifier: Apache-2.0
// Which targets of a sieve the rays listed for instances may meet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/sift.glsl"

void main() {
    uint lane = balancedLane(), path = listEntry(lane);
    bool live = path != NO_INDEX;
    path = live ? path : 0u;
    sift(lane, live, asVector(loadPathTexel(path, PATH_ORIGIN)), asVector(loadPathTexel(path, PATH_DIRECTION)),
         uintBitsToFloat(loadHit(path).x));
}
