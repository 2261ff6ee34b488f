// SPDX-License-Identifier: Apache-2.0
// Shades the hits of the ray queue (wavefront form): accumulates emission and the background, queues direct-lighting
// queries, and queues the next rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/continue_path.glsl"
#include "shaders/shade/film.glsl"
#include "shaders/shade/gaussian_light.glsl"
#include "shaders/lib/append.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes take part: appending needs the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction point = findInteraction(index, path, hit);
    uint bounce = bounceOf(path.bits);
    vec4 gaussians = loadGaussianLight(index);
    vec3 before = passGaussians(path, gaussians);
    bool covered = covers(point);
    vec3 albedo = albedoBehind(covered ? point.albedo : vec3(0.0), gaussians, index);
    ShadedHit shaded = shadeAt(path, point, index);
    Shading shading = shaded.shading;
    if (live && kCameraPass) {
        float coverage = coverageBehind(covered ? 1.0 : 0.0, gaussians);
        PixelSums sums = beginSample(loadSums(index, 0u), coverage, albedo, push.sample_index);
        accumulateLight(sums, shading.radiance + before, bounce);
        storeSums(index, 0u, sums);
    }
    if (live && !kCameraPass) accumulateLight(index, shading.radiance + before, bounce);
    bool lit = live && needsDirectLight(shading);
    appendEntry(LIST_DIRECT_LIGHT, lit, index);
    if (lit) light_queries[index] = lightQuery(shaded.point, -path.direction, shading.direct_weight, bounce);

    PathState next;
    if (mayHaveSecondaryRays())
        appendRay(continuePath(path, shaded.point, shading, index, live, next), index, next);
}
