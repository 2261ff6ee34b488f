// SPDX-License-Identifier: Apache-2.0
// Any-hit intersection of a shadow ray with one instance, or with the tiles in a block.
#ifndef POINTRT_SHADERS_OCCLUSION_GLSL
#define POINTRT_SHADERS_OCCLUSION_GLSL
#define ANY_HIT
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"
#ifdef POOLED
#include "shaders/trace/cull.glsl"
#endif

bool isOccludedByInstance(ShadowRay ray) {
    TraceRay in_cube = secondaryRay(ray.origin, ray.direction, ray.t_max * cubeScale(), ray.self_normal, ray.owner,
                                    ray.self_t);
    return trace(in_cube).disc != NO_INDEX;
}

// Whether the instance or a tile occludes the ray that the program's loadRay loads for an entry. A ray with negative
// t_max hits nothing.
#ifdef POOLED
bool isOccluded(uint entry) {
    ShadowRay ray = loadRay(entry);
    uint tiles = ray.t_max >= 0.0 ? cullMask(cullRay(ray.origin, ray.direction, ray.t_max)) : 0u;
    bool occluded = false;
    while (tiles != 0u) {
        selectTile(uint(findLSB(tiles)));
        occluded = isOccludedByInstance(loadRay(again(entry)));
        tiles = occluded ? 0u : tiles & (tiles - 1u);
    }
    return occluded;
}
#else
#define again(entry) entry
bool isOccluded(uint entry) { return isOccludedByInstance(loadRay(entry)); }
#endif

#endif
