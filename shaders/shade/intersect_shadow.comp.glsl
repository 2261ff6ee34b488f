// SPDX-License-Identifier: Apache-2.0
// Intersects the shadow rays of LIST_SHADOW_RAYS, or of a culled list, with one instance, and marks the light samples
// that the instance occludes. shade_shadow adds the light of the other samples.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#define loadRay(entry) shadowRayOfEntry(entry)
#include "shaders/shade/occlusion.glsl"

void main() {
    uint entry = listEntry(balancedLane());
    if (entry == NO_INDEX) return;
    if (isOccluded(entry))
        atomicOr(light_masks[pathOfEntry(entry)], 1u << lightSampleOfEntry(entry));
}
