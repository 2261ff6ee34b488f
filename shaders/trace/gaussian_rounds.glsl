// SPDX-License-Identifier: Apache-2.0
// Rounds that composite Gaussians: the first round processes the current rays, each further round those that the
// previous round listed.
#ifndef POINTRT_SHADERS_GAUSSIAN_ROUNDS_GLSL
#define POINTRT_SHADERS_GAUSSIAN_ROUNDS_GLSL
#include "shaders/lib/append.glsl"
#include "shaders/lib/path.glsl"

// The path of a lane.
PathState pathOfRound(out uint index) {
    if (!hasStep(STEP_RESUME)) return currentPath(index);
    index = listEntry(balancedLane());
    return pathOf(index != NO_INDEX ? index : 0u);
}

// All lanes of the subgroup must call it.
void listForNextRound(bool continues, uint path) {
    appendEntry(push.list == LIST_DIRECT_LIGHT ? LIST_SHADOW_RAYS : LIST_DIRECT_LIGHT, continues, path);
}

#endif
