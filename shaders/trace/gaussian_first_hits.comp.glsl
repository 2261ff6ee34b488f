// SPDX-License-Identifier: Apache-2.0
// First hits of an instance of Gaussians: depth, normal and ids (AOVs) of the rays through pixel centres. A ray hits
// the Gaussian behind which less than half of the light passes, if no surface is nearer. The id is that of the Gaussian
// that adds most to the pixel up to that depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_first_hit.glsl"
#include "shaders/shared/film_parts.h"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX, enters;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(live ? index : 0u));
    float surface = live ? first_hits[at].w : 0.0;
    float t_max = (surface >= 0.0 ? surface : 1e30) * cubeScale();
    GaussianRay ray = gaussianRay(path.origin, path.direction, t_max, enters);
    FirstHit first = firstHitAlong(ray, enters, live);
    if (first.middle.gaussian == NO_INDEX) return;
    float t = (ray.t_start + first.middle.t) / cubeScale();
    vec3 normal = gaussianNormal(first.middle.gaussian, ray.direction);
    first_hits[at] = vec4(renderDirection(normalize(normal)), t);
    uint owner = instance.materials.x | instance.grid_origin.w << HIT_TILE_SHIFT;
    uvec3 ids = uvec3(first.strongest.gaussian, owner, instance.materials.y);
    first_hits[at + 1u] = vec4(uintBitsToFloat(ids), 1.0);
}
