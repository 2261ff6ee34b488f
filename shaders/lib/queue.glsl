// SPDX-License-Identifier: Apache-2.0
// Which lane works on what.
#ifndef POINTRT_SHADERS_QUEUE_GLSL
#define POINTRT_SHADERS_QUEUE_GLSL
#include "shaders/lib/balanced_lane.glsl"

// The path this lane works on in the queue of the step, or NO_INDEX.
uint queuedIndex(uint lane) {
    bool second = hasStep(STEP_QUEUE_ONE);
    return lane < control.queued[second ? 1 : 0] ? loadQueue(rayQueueStart(second) + lane) : NO_INDEX;
}

// The lane's entry in the list that the program goes by, or NO_INDEX.
uint listEntry(uint lane) {
    uint count = control.lists[push.list].count, start = control.lists[push.list].start;
    return lane < count ? loadQueue(start + lane) : NO_INDEX;
}

#endif
