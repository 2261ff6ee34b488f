// SPDX-License-Identifier: Apache-2.0
// Accumulates the contributions of the megakernel's unoccluded shadow rays. For culled lists only: without culling,
// intersect_shadow_ray accumulates them at the last instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film.glsl"
#include "shaders/shade/shadow_ray.glsl"

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    ShadowRay ray = loadShadowRay(path);
    if (ray.t_max >= 0.0) accumulateLight(path, ray.light, ray.scatterings);
}
