// SPDX-License-Identifier: Apache-2.0
// Intersects the megakernel's shadow rays, which are stored with their contributions, with one instance. At the last
// instance, accumulates the contributions of unoccluded rays; for culled lists, accumulate_shadow accumulates them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film.glsl"
#include "shaders/shade/shadow_ray.glsl"
#define loadRay(path) loadShadowRay(path)
#include "shaders/shade/occlusion.glsl"

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    bool occluded = isOccluded(path);
    if (!hasStep(STEP_LAST)) {
        if (occluded) shadow_rays[path].t_max = -1.0;
        return;
    }
    ShadowRay ray = loadShadowRay(again(path));
    if (!occluded && ray.t_max >= 0.0) accumulateLight(path, ray.light, ray.scatterings);
}
