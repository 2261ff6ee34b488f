// SPDX-License-Identifier: Apache-2.0
// The queue or list entry of a lane.
#ifndef POINTRT_SHADERS_QUEUE_GLSL
#define POINTRT_SHADERS_QUEUE_GLSL
#include "shaders/lib/balanced_lane.glsl"

// The path of a lane in the ray queue of the step, or NO_INDEX.
uint queuedIndex(uint lane) {
    bool second = hasStep(STEP_QUEUE_ONE);
    return lane < control.queued[second ? 1 : 0] ? loadQueue(rayQueueStart(second) + lane) : NO_INDEX;
}

// The entry of a lane in the program's input list (push.list), or NO_INDEX.
uint listEntry(uint lane) {
    uint count = control.lists[push.list].count, start = control.lists[push.list].start;
    return lane < count ? loadQueue(start + lane) : NO_INDEX;
}

#endif
