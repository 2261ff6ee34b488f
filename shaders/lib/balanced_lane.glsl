// SPDX-License-Identifier: Apache-2.0
// Which lane comes when.
#ifndef POINTRT_SHADERS_BALANCED_LANE_GLSL
#define POINTRT_SHADERS_BALANCED_LANE_GLSL
#include "shaders/shared/params.h"

layout(local_size_x = WORKGROUP_SIZE) in;

// Workgroups in a stretch: their entries and paths come to many pages, through which processors read ahead.
#define STRETCH 16u

// lavapipe hands the first half of the workgroups to one thread and the rest to another: each takes one of every two
// stretches, so that neither is left with the sky. Which one changes as in the Thue-Morse sequence, for in turn they
// would share out the image by columns, where the stretches of a row are even in number.
uint balancedLane() {
    uint half_count = (gl_NumWorkGroups.x + 1u) >> 1;
    uint side = gl_WorkGroupID.x < half_count ? 0u : 1u, group = gl_WorkGroupID.x - side * half_count;
    // what is left over when each side has had its last whole stretch goes by single workgroups
    uint in_stretches = gl_NumWorkGroups.x / (2u * STRETCH) * STRETCH;
    uint second = side ^ (uint(bitCount(group / STRETCH)) & 1u);
    uint mixed = group < in_stretches ? 2u * group - group % STRETCH + second * STRETCH : 2u * group + side;
    return mixed * WORKGROUP_SIZE + gl_LocalInvocationID.x;
}

#endif
