// SPDX-License-Identifier: Apache-2.0
// Path state after scattering at a hit.
#ifndef POINTRT_SHADERS_SCATTERED_PATH_GLSL
#define POINTRT_SHADERS_SCATTERED_PATH_GLSL
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shade/make_bsdf.glsl"
#include "shaders/trace/offset.glsl"
#include "shaders/shade/shading.glsl"

// The material at a hit with resolved sides. Scans of glass have holes and rims: a ray that meets the inner side of
// glass without having entered passes as through a pane, since its distance in the glass is unknown. Shapes are closed,
// so there such a ray must have started inside.
Material interfaceMaterial(SurfaceInteraction point, PathState path) {
    Material row = loadMaterial(materialOf(point));
    bool entered = (path.bits & PATH_INSIDE) != 0u || point.owner == OWNER_SHAPES;
    row.base.w = uintBitsToFloat(materialBits(row) | (isBack(point) && !entered ? MATERIAL_THIN : 0u));
    return row;
}

// deferred_count: deferred rays of the pixel.
PathState scatteredPath(SurfaceInteraction point, PathState path, NextRay ray, uint deferred_count) {
    // a transmitted ray leaves the surface on its other side
    bool crosses = dot(point.normal, ray.direction) < 0.0;
    float self_t;
    vec3 side = crosses ? -point.normal : point.normal;
    vec3 origin = offsetRayOrigin(point.position, side, point.radius, point.bits, ray.direction, self_t);
    Material row = loadMaterial(materialOf(point));
    uint before = path.bits;
    bool enters_or_leaves = crosses && !isThin(row) && point.owner != OWNER_SHAPES;
    bool inside = enters_or_leaves ? !isBack(point) : (before & PATH_INSIDE) != 0u;
    uint bits = bounceOf(before) + 1u | deferred_count << PATH_DEFERRED_SHIFT | (inside ? PATH_INSIDE : 0u) |
                point.owner << PATH_OWNER_SHIFT;
    bool is_delta = ray.pdf == 0.0, diffused = is_delta ? (before & PATH_DIFFUSED) != 0u : gathersPhotons(row);
    bits |= diffused ? PATH_DIFFUSED : 0u;
    bits |= is_delta && diffused && (point.bits & SURFACE_CASTS) != 0u ? PATH_CAUSTIC : 0u;
    // the stored orientation, since of two close sheets the ray may hit the other one
    vec3 stored_normal = isBack(point) ? -point.normal : point.normal;
    return PathState(origin, self_t, ray.direction, ray.pdf, ray.weight, 0u, stored_normal, bits);
}

#endif
