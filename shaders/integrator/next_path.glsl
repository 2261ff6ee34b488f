// SPDX-License-Identifier: Apache-2.0
// From a hit to the path that goes on from there.
#ifndef POINTRT_SHADERS_NEXT_PATH_GLSL
#define POINTRT_SHADERS_NEXT_PATH_GLSL
#include "shaders/surface/surface_interaction.glsl"
#include "shaders/material/matter.glsl"
#include "shaders/trace/offset.glsl"
#include "shaders/integrator/shading.glsl"

// With waiting rays of the pixel behind it.
PathState pathAfter(SurfaceInteraction point, PathState path, NextRay ray, uint waiting) {
    // light that crosses the surface leaves it on its other side
    bool crosses = dot(point.normal, ray.direction) < 0.0;
    float own_t;
    vec3 origin = leaveSurface(point.position, crosses ? -point.normal : point.normal, point.radius, ray.direction, own_t);
    Material row = loadMaterial(point.material);
    uint before = pathBits(path);
    uint bits = bounceOf(before) + 1u | waiting << PATH_DEFERRED_SHIFT | before & PATH_INSIDE |
                point.owner << PATH_OWNER_SHIFT;
    bool sharp = ray.pdf == 0.0, diffused = sharp ? (before & PATH_DIFFUSED) != 0u : gathersPhotons(row);
    bits |= diffused ? PATH_DIFFUSED : 0u;
    bits |= sharp && diffused && point.casts ? PATH_CAUSTIC : 0u;
    bits ^= crosses && !isThin(row) ? PATH_INSIDE : 0u;
    // as stored, so that of two sheets close to each other the other one is met
    vec3 stored_normal = point.back ? -point.normal : point.normal;
    return PathState(vec4(origin, own_t), vec4(ray.direction, ray.pdf), vec4(ray.weight, 0.0),
                     vec4(stored_normal, uintBitsToFloat(bits)));
}

#endif
