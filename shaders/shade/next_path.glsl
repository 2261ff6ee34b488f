// SPDX-License-Identifier: Apache-2.0
// From a hit to the path that goes on from there.
#ifndef POINTRT_SHADERS_NEXT_PATH_GLSL
#define POINTRT_SHADERS_NEXT_PATH_GLSL
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shade/make_bsdf.glsl"
#include "shaders/trace/offset.glsl"
#include "shaders/shade/shading.glsl"

// With waiting rays of the pixel behind it.
PathState pathAfter(SurfaceInteraction point, PathState path, NextRay ray, uint waiting) {
    // light that crosses the surface leaves it on its other side
    bool crosses = dot(point.normal, ray.direction) < 0.0;
    float own_t;
    vec3 side = crosses ? -point.normal : point.normal;
    vec3 origin = leaveSurface(point.position, side, point.radius, point.bits, ray.direction, own_t);
    Material row = loadMaterial(materialOf(point));
    uint before = path.bits;
    uint bits = bounceOf(before) + 1u | waiting << PATH_DEFERRED_SHIFT | before & PATH_INSIDE |
                point.owner << PATH_OWNER_SHIFT;
    bool sharp = ray.pdf == 0.0, diffused = sharp ? (before & PATH_DIFFUSED) != 0u : gathersPhotons(row);
    bits |= diffused ? PATH_DIFFUSED : 0u;
    bits |= sharp && diffused && (point.bits & SURFACE_CASTS) != 0u ? PATH_CAUSTIC : 0u;
    bits ^= crosses && !isThin(row) ? PATH_INSIDE : 0u;
    // as stored, so that of two sheets close to each other the other one is met
    vec3 stored_normal = isBack(point) ? -point.normal : point.normal;
    return PathState(origin, own_t, ray.direction, ray.pdf, ray.weight, 0u, stored_normal, bits);
}

#endif
