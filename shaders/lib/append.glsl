// SPDX-License-Identifier: Apache-2.0
// Queues and lists that a whole subgroup appends to at once.
#ifndef POINTRT_SHADERS_APPEND_GLSL
#define POINTRT_SHADERS_APPEND_GLSL
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require

// Beside LIST_*.
#define APPEND_RAY LISTS // to the queue that the step does not read
#define APPEND_HIT (LISTS + 1u)

uint addToCount(uint list, uint more) {
    if (list == APPEND_HIT) return atomicAdd(control.hits_appended, more);
    if (list == APPEND_RAY) return atomicAdd(control.queued[hasStep(STEP_QUEUE_ONE) ? 0 : 1], more);
    return atomicAdd(control.lists[list].appended, more);
}

uint appendStart(uint list) {
    if (list == APPEND_HIT) return hitListStart();
    if (list == APPEND_RAY) return rayQueueStart(!hasStep(STEP_QUEUE_ONE));
    return listStart(list);
}

// list: a constant, APPEND_* or LIST_*.
void appendEntry(uint list, bool wants, uint entry) {
    uvec4 ballot = subgroupBallot(wants);
    uint total = subgroupBallotBitCount(ballot);
    uint start = 0u;
    if (subgroupElect() && total > 0u) start = addToCount(list, total);
    uint slot = subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
    if (wants) queues[appendStart(list) + slot] = entry;
}

void appendRay(bool wants, uint index, PathState path) {
    appendEntry(APPEND_RAY, wants, index);
    if (wants) paths[index] = path;
}

#endif
