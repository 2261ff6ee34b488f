// SPDX-License-Identifier: Apache-2.0
// Workgroups of an indirect dispatch, as the host and prepare set them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_GROUPS_FOR_H
#define POINTRT_SHADERS_GROUPS_FOR_H

#include "shaders/shared/params.h"

#ifdef __cplusplus
namespace pointrt::gpu {
inline
#endif
    uvec3
    groupsFor(uint lanes) {
    uvec3 groups;
    groups.x = (lanes + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE;
    groups.y = groups.z = 1u;
    return groups;
}

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif
