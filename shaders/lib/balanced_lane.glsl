// SPDX-License-Identifier: Apache-2.0
// Order of the lanes of a dispatch.
#ifndef POINTRT_SHADERS_BALANCED_LANE_GLSL
#define POINTRT_SHADERS_BALANCED_LANE_GLSL
#include "shaders/shared/params.h"

layout(local_size_x = WORKGROUP_SIZE) in;

// Workgroups in a stretch: enough that their entries and paths span many memory pages, so that CPUs can prefetch.
#define STRETCH 16u

// lavapipe gives the first half of the workgroups to one thread and the rest to another. Each half takes one of every
// two stretches, so that neither gets all of the sky. The Thue-Morse sequence decides which: strict alternation would
// split the image by columns if a row has an even number of stretches.
uint balancedLane() {
    uint half_count = (gl_NumWorkGroups.x + 1u) >> 1;
    uint side = gl_WorkGroupID.x < half_count ? 0u : 1u, group = gl_WorkGroupID.x - side * half_count;
    // the workgroups after the last complete pair of stretches alternate one by one
    uint in_stretches = gl_NumWorkGroups.x / (2u * STRETCH) * STRETCH;
    uint second = side ^ (uint(bitCount(group / STRETCH)) & 1u);
    uint mixed = group < in_stretches ? 2u * group - group % STRETCH + second * STRETCH : 2u * group + side;
    return mixed * WORKGROUP_SIZE + gl_LocalInvocationID.x;
}

#endif
