// SPDX-License-Identifier: Apache-2.0
// Which lane works on what.
#ifndef POINTRT_SHADERS_QUEUE_GLSL
#define POINTRT_SHADERS_QUEUE_GLSL
#include "shaders/frame/balanced_lane.glsl"

// The path this lane works on in the queue of the step, or NO_INDEX.
uint queuedIndex(uint lane) {
    bool second = hasStep(STEP_QUEUE_ONE);
    return lane < control.queued[second ? 1 : 0] ? loadQueue(rayQueueStart(second) + lane) : NO_INDEX;
}

// The lane's entry in the list of rays for instances, or NO_INDEX.
uint askedEntry(uint lane) {
    return lane < control.asked_count ? loadQueue(askedListStart() + lane) : NO_INDEX;
}

// And in that of shadow rays.
uint turnEntry(uint lane) { return lane < control.turn_count ? loadQueue(turnListStart() + lane) : NO_INDEX; }

#endif
