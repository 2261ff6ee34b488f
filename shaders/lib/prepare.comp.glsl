// SPDX-License-Identifier: Apache-2.0
// A single lane between dispatches: turns queue lengths into group counts of the next dispatches, and counts rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/bindings.glsl"
#include "shaders/shared/groups_for.h"

layout(local_size_x = 1) in;

void setList(uint list, uint start, uint count) {
    control.lists[list].groups = groupsFor(count);
    control.lists[list].count = count;
    control.lists[list].start = start;
    control.lists[list].appended = 0u;
    control.lists[list].compacted = 0u;
}

void emptyHits() {
    control.hit_groups = groupsFor(0u);
    control.hit_count = 0u;
    for (uint list = LIST_CULLED; list < LISTS; list++) control.lists[list].hits = 0u;
}

void reset() {
    control.queued[0] = 0u;
    control.queued[1] = 0u;
    control.ray_groups = groupsFor(bandLanes());
    control.tile_groups = groupsFor(0u);
    control.tile_count = 0u;
    emptyHits();
    for (uint list = 0u; list < LISTS; list++) setList(list, 0u, 0u);
    control.primary_rays = params.width * params.rows;
    control.shadow_rays = 0u;
    control.secondary_rays = 0u;
    control.cut_rays = 0u;
}

void closeList(uint list) { setList(list, listStart(list), control.lists[list].appended); }

// Empties the ray queue just shaded; the other one holds the next rays. The lists that shading has appended to are
// complete.
void swapQueues() {
    bool second = hasStep(STEP_QUEUE_ONE);
    uint next = control.queued[second ? 0 : 1];
    control.secondary_rays += next;
    control.queued[second ? 1 : 0] = 0u;
    control.ray_groups = groupsFor(next);
    closeList(LIST_DIRECT_LIGHT);
    closeList(LIST_INSTANCE_RAYS);
    closeList(LIST_SHADOW_RAYS);
    emptyHits();
}

// Allocates the culled lists of a cull group one after the other. An instance whose list does not fit gets all entries
// of the list before culling.
void allocateCulledLists(uint source) {
    uint start = culledListStart();
    for (uint list = LIST_CULLED; list < LISTS; list++) {
        uint count = control.lists[list].appended;
        bool fits = count <= culledListEnd() - start;
        setList(list, fits ? start : control.lists[source].start, fits ? count : control.lists[source].count);
        start += fits ? count : 0u;
    }
}

void main() {
    if (hasStep(STEP_RESET)) {
        reset();
    } else if (hasStep(STEP_LIST)) {
        closeList(push.list);
    } else if (hasStep(STEP_CULLED)) {
        allocateCulledLists(push.list);
    } else if (hasStep(STEP_HITS)) {
        emptyHits();
    } else {
        swapQueues();
    }
}
