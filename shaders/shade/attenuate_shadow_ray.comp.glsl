// SPDX-License-Identifier: Apache-2.0
// Attenuates the megakernel's shadow rays, which are stored with their contributions, by an instance of Gaussians.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/shadow_ray.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_transmittance.glsl"

void main() {
    uint path = listEntry(balancedLane());
    bool live = path != NO_INDEX, enters;
    ShadowRay shadow = loadShadowRay(live ? path : 0u);
    GaussianRay ray = gaussianRay(shadow.origin, shadow.direction, shadow.t_max * cubeScale(), enters);
    float passes = gaussianTransmittance(ray, enters, live && shadow.t_max > 0.0);
    if (live) shadow_rays[path].light = shadow.light * passes;
}
