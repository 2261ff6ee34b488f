// SPDX-License-Identifier: Apache-2.0
// Stream compaction after culling: copies each entry of the tested list to the culled lists of the instances in the
// entry's cull mask.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"

// One atomic per subgroup: all its lanes must call it.
void copyEntry(uint list, bool copies, uint entry) {
    uint start = control.lists[list].start;
    // an instance without room for a list of its own shares the list before culling
    copies = copies && start >= culledListStart();
    uvec4 ballot = subgroupBallot(copies);
    uint total = subgroupBallotBitCount(ballot), compacted = 0u;
    if (subgroupElect() && total > 0u) compacted = atomicAdd(control.lists[list].compacted, total);
    uint slot = start + subgroupBroadcastFirst(compacted) + subgroupBallotExclusiveBitCount(ballot);
    if (copies) queues[slot] = entry;
}

void main() {
    uint lane = balancedLane(), entry = listEntry(lane);
    uint mask = entry != NO_INDEX ? loadQueue(cullMaskStart() + lane) : 0u;
    uint left = subgroupOr(mask);
    do {
        uint instance_bit = left != 0u ? uint(findLSB(left)) : 0u;
        copyEntry(LIST_CULLED + instance_bit, (mask >> instance_bit & 1u) != 0u, entry);
        left &= left - 1u;
    } while (left != 0u);
}
