// SPDX-License-Identifier: Apache-2.0
// Surface interactions of the hits on one instance: the blended surface, its colour and its material, in render space.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/blend.glsl"
#include "shaders/trace/offset.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shared/film_parts.h"

bool between(vec3 v, uint low, uint high) {
    // stored colours have 256 steps, blended ones are continuous: half a step of tolerance
    const float kHalfStep = 0.5 / 255.0;
    return all(greaterThanEqual(v, unpackUnorm4x8(low).rgb - kHalfStep)) &&
           all(lessThanEqual(v, unpackUnorm4x8(high).rgb + kHalfStep));
}

// Row of the material of a surface in the scene's table.
uint materialOf(BlendedSurface surface) {
    uint material = instance.materials.y + surface.material;
    uint ranges = ofLane(instance.materials.z);
    for (uint i = 0u; i < ranges; i++) {
        uvec4 range = loadColorRange(i);
        if (between(surface.color, range.x, range.y)) material = range.z;
    }
    return material;
}

void main() {
    uint lane = balancedLane();
    if (lane >= control.hit_count) return;
    uint index = loadQueue(hitListStart() + lane);
    PathState path = pathOf(index);
    uvec4 hit = loadHit(index);
#ifdef POOLED
    selectTile(hit.w >> HIT_PLACE_SHIFT);
    hit.w &= HIT_OWNER_MASK;
#endif
    uint t_hit = hit.x; // the t with which the hits of further instances are compared
    hit.x = floatBitsToUint(uintBitsToFloat(hit.x) * cubeScale());
    BlendedSurface surface = surfaceAt(cubePoint(path.origin), cubeDirection(path.direction), path.self_t * cubeScale(), hit,
                                       isSeen(path.bits));
    float t = surface.t / cubeScale();
    uint material = materialOf(surface);
    Material row = loadMaterial(material);
    vec3 albedo = row.base.rgb * (usesSplatColor(row) ? linearFromSrgb(surface.color) : vec3(1.0));
    uint sides = (surface.sided ? SURFACE_SIDED : 0u) | (surface.back ? SURFACE_BACK : 0u);
    uint casts = instance.materials.w != 0u ? SURFACE_CASTS : 0u;
    uint reach = 0u;
    float radius = surface.radius * instance.core_high.w;
    if (kNoisy) radius = offsetRadius(radius, surface.noise, reach);
    surfaces[index] =
        StoredSurface(renderDirection(surface.normal), material | sides | casts | reach, albedo, t);
    imageStore(hit_texels, int(index),
               uvec4(t_hit, floatBitsToUint(radius / cubeScale()), surface.splat,
                     hit.w | instance.grid_origin.w << HIT_TILE_SHIFT));
}
