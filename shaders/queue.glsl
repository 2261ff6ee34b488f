// SPDX-License-Identifier: Apache-2.0
// Which lane works on what.
#ifndef POINTRT_SHADERS_QUEUE_GLSL
#define POINTRT_SHADERS_QUEUE_GLSL

// lavapipe hands the first half of the workgroups to one thread and the rest to another: taking them in turn gives
// each thread every second stretch of the image, so that neither is left with the sky.
uint balancedLane() {
    uint group = gl_WorkGroupID.x;
    uint half_count = (gl_NumWorkGroups.x + 1u) >> 1;
    uint mixed = group < half_count ? 2u * group : 2u * (group - half_count) + 1u;
    return mixed * WORKGROUP_SIZE + gl_LocalInvocationID.x;
}

// The path this lane works on in the queue of the step, or NO_INDEX.
uint queuedIndex(uint lane) {
    bool second = hasStep(STEP_QUEUE_ONE);
    uint count = second ? control.queued.y : control.queued.x;
    return lane < count ? loadQueue(rayQueueStart(second) + lane) : NO_INDEX;
}

// The lane's entry in the list of rays for instances, or NO_INDEX.
uint askedEntry(uint lane) {
    return lane < control.asked_groups.w ? loadQueue(askedListStart() + lane) : NO_INDEX;
}

#endif
