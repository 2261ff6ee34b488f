// SPDX-License-Identifier: Apache-2.0
// Attenuates the megakernel's shadow rays, which are stored with their contributions, by an instance of Gaussians.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/shadow_ray.glsl"
#include "shaders/shade/gaussian_shadow.glsl"

void main() {
    uint path = listEntry(balancedLane());
    bool live = path != NO_INDEX;
    ShadowRay shadow = loadShadowRay(live ? path : 0u);
    float passes = passedByGaussians(shadow, live);
    if (live) shadow_rays[path].light = shadow.light * passes;
}
