// SPDX-License-Identifier: Apache-2.0
// Appends to queues and lists, one atomic per subgroup (stream compaction).
#ifndef POINTRT_SHADERS_APPEND_GLSL
#define POINTRT_SHADERS_APPEND_GLSL
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require

// Further destinations beside LIST_*.
#define APPEND_RAY LISTS // the ray queue that the step does not read
#define APPEND_HIT (LISTS + 1u) // the hit list

uint addToCount(uint list, uint more) {
    if (list == APPEND_HIT) {
        uint start = atomicAdd(control.hit_count, more);
        atomicMax(control.hit_groups.x, (start + more + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE);
        return start;
    }
    if (list == APPEND_RAY) return atomicAdd(control.queued[hasStep(STEP_QUEUE_ONE) ? 0 : 1], more);
    return atomicAdd(control.lists[list].appended, more);
}

uint appendStart(uint list) {
    if (list == APPEND_HIT) return hitListStart();
    if (list == APPEND_RAY) return rayQueueStart(!hasStep(STEP_QUEUE_ONE));
    return listStart(list);
}

// list: a constant, APPEND_* or LIST_*. All lanes of the subgroup must call it; those with appends add their entry.
void appendEntry(uint list, bool appends, uint entry) {
    uvec4 ballot = subgroupBallot(appends);
    uint total = subgroupBallotBitCount(ballot);
    uint start = 0u;
    if (subgroupElect() && total > 0u) start = addToCount(list, total);
    uint slot = subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
    if (appends) queues[appendStart(list) + slot] = entry;
}

void appendRay(bool appends, uint index, PathState path) {
    appendEntry(APPEND_RAY, appends, index);
    if (appends) paths[index] = path;
}

#endif
