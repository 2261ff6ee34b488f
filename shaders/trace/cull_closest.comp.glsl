// SPDX-License-Identifier: Apache-2.0
// Culls the rays of LIST_INSTANCE_RAYS against the boxes of a group of instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/cull.glsl"

void main() {
    uint lane = balancedLane(), path = listEntry(lane);
    bool live = path != NO_INDEX;
    path = live ? path : 0u;
    cullEntry(lane, live, asVector(loadPathTexel(path, PATH_ORIGIN)), asVector(loadPathTexel(path, PATH_DIRECTION)),
              uintBitsToFloat(loadHit(path).x));
}
