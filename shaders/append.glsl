// SPDX-License-Identifier: Apache-2.0
// Queues that a whole subgroup appends to at once.
#ifndef POINTRT_SHADERS_APPEND_GLSL
#define POINTRT_SHADERS_APPEND_GLSL

uint appendSlot(bool wants, bool lit) {
    uvec4 ballot = subgroupBallot(wants);
    uint total = subgroupBallotBitCount(ballot);
    uint start = 0u;
    if (subgroupElect() && total > 0u) {
        if (lit) start = atomicAdd(control.queued.z, total);
        else start = hasStep(STEP_QUEUE_ONE) ? atomicAdd(control.queued.x, total) : atomicAdd(control.queued.y, total);
    }
    return subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
}

void appendRay(bool wants, uint index, PathState path) {
    uint slot = appendSlot(wants, false);
    if (!wants) return;
    queues[rayQueueStart(!hasStep(STEP_QUEUE_ONE)) + slot] = index;
    paths[index] = path;
}

#endif
