// SPDX-License-Identifier: Apache-2.0
// Draws the light samples of the points of LIST_DIRECT_LIGHT and intersects their shadow rays with the shapes. Marks
// light samples that are below the surface or occluded; appends the rays that instances may still occlude to
// LIST_SHADOW_RAYS.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/shape_shadow.glsl"
#include "shaders/lib/append.glsl"

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    bool live = path != NO_INDEX;
    uint first = push.first_light_sample, end = min(lightSampleCount(), first + SHADOW_RAYS_PER_PATH), traced = 0u;
    uint mask = live && first > 0u ? light_masks[path] : 0u;
    for (uint number = first; number < end; number++) {
        LightRay ray = lightRay(query, live ? path : 0u, number);
        bool shadows = castsShadow(ray), faces = live && facesLight(query, ray.to);
        ShapeHit hit = nearestShape(ofLane(params.shape_count), ray.origin, ray.to.direction,
                                    shapeMinDistance(query.owner, ray.origin));
        bool dark = !faces || (shadows && occludes(hit, ray));
        mask |= dark ? 1u << number : 0u;
        traced += faces && shadows ? 1u : 0u;
        bool waits = shadows && !dark && mayHitInstances(ray);
        appendEntry(LIST_SHADOW_RAYS, waits, path | number << SHADOW_RAY_LIGHT_SHIFT);
    }
    traced = subgroupAdd(traced);
    if (subgroupElect() && traced > 0u) atomicAdd(control.shadow_rays, traced);
    if (live) light_masks[path] = mask;
}
