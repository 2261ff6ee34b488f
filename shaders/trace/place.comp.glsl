// SPDX-License-Identifier: Apache-2.0
// The entries of a list that was sifted, into the lists of the targets whose bits they have.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"

// Those of the whole subgroup at once.
void placeEntry(uint list, bool wants, uint entry) {
    uint start = control.lists[list].start;
    // a target without room for a list of its own has all that were sifted
    wants = wants && start >= siftedStart();
    uvec4 ballot = subgroupBallot(wants);
    uint total = subgroupBallotBitCount(ballot), placed = 0u;
    if (subgroupElect() && total > 0u) placed = atomicAdd(control.lists[list].placed, total);
    uint slot = start + subgroupBroadcastFirst(placed) + subgroupBallotExclusiveBitCount(ballot);
    if (wants) queues[slot] = entry;
}

void main() {
    uint lane = balancedLane(), entry = listEntry(lane);
    uint met = entry != NO_INDEX ? loadQueue(sieveBitsStart() + lane) : 0u;
    uint left = subgroupOr(met);
    do {
        uint target = left != 0u ? uint(findLSB(left)) : 0u;
        placeEntry(LIST_SIFTED + target, (met >> target & 1u) != 0u, entry);
        left &= left - 1u;
    } while (left != 0u);
}
