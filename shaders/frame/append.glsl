// SPDX-License-Identifier: Apache-2.0
// Queues and lists that a whole subgroup appends to at once.
#ifndef POINTRT_SHADERS_APPEND_GLSL
#define POINTRT_SHADERS_APPEND_GLSL
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require

#define APPEND_RAY 0u // to the queue that the step does not read
#define APPEND_LIGHT_QUERY 1u
#define APPEND_ASKED 2u
#define APPEND_HIT 3u
#define APPEND_TURN 4u

uint addToCount(uint list, uint more) {
    if (list == APPEND_LIGHT_QUERY) return atomicAdd(control.light_queries_appended, more);
    if (list == APPEND_ASKED) return atomicAdd(control.asked_appended, more);
    if (list == APPEND_HIT) return atomicAdd(control.hits_appended, more);
    if (list == APPEND_TURN) return atomicAdd(control.turns_appended, more);
    return atomicAdd(control.queued[hasStep(STEP_QUEUE_ONE) ? 0 : 1], more);
}

uint listStart(uint list) {
    if (list == APPEND_LIGHT_QUERY) return lightQueueStart();
    if (list == APPEND_ASKED) return askedListStart();
    if (list == APPEND_HIT) return hitListStart();
    if (list == APPEND_TURN) return turnListStart();
    return rayQueueStart(!hasStep(STEP_QUEUE_ONE));
}

// list: an APPEND_* constant.
void appendEntry(uint list, bool wants, uint entry) {
    uvec4 ballot = subgroupBallot(wants);
    uint total = subgroupBallotBitCount(ballot);
    uint start = 0u;
    if (subgroupElect() && total > 0u) start = addToCount(list, total);
    uint slot = subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
    if (wants) queues[listStart(list) + slot] = entry;
}

void appendRay(bool wants, uint index, PathState path) {
    appendEntry(APPEND_RAY, wants, index);
    if (wants) paths[index] = path;
}

#endif
