// SPDX-License-Identifier: Apache-2.0
// The surface interaction at the hit of a path, on a shape or on splats.
#ifndef POINTRT_SHADERS_SURFACE_INTERACTION_GLSL
#define POINTRT_SHADERS_SURFACE_INTERACTION_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/trace/shapes.glsl"
#include "shaders/shared/film_parts.h"

// A ray's hit as shading sees it.
struct SurfaceInteraction {
    vec3 position;
    float radius; // mean radius of the blended splats, larger if they are noisy (offsetRadius); 0 on shapes
    vec3 normal;  // facing the viewer
    uint bits;    // material and SURFACE_*
    vec3 albedo;  // linear
    float t;      // along the ray; negative: a miss
    uint owner;
    uint primitive; // splat, or shape
    uint tile;      // 1 + number of the splat's tile in its set; 0: not in a set
};

uint materialOf(SurfaceInteraction point) { return point.bits & SURFACE_MATERIAL_MASK; }
bool isBack(SurfaceInteraction point) { return (point.bits & SURFACE_BACK) != 0u; }

// Decides whether the hit is on the back. Without oriented normals, crossings alternate: every second crossing leaves
// the glass.
void resolveSides(inout SurfaceInteraction point, PathState path) {
    bool back = (point.bits & SURFACE_SIDED) != 0u ? isBack(point) : (path.bits & PATH_INSIDE) != 0u;
    point.bits = point.bits & ~SURFACE_BACK | (back ? SURFACE_BACK : 0u);
}

SurfaceInteraction noInteraction() {
    return SurfaceInteraction(vec3(0.0), 0.0, vec3(0.0), SURFACE_SIDED, vec3(0.0), -1.0, NO_OWNER, NO_INDEX, 0u);
}

SurfaceInteraction shapeInteraction(PathState path, uvec4 hit) {
    Shape shape = loadShape(hit.z);
    float t = uintBitsToFloat(hit.x);
    vec3 position = path.origin + t * path.direction;
    bool back;
    vec3 normal = shapeNormal(shape, position, path.direction, back);
    bool casts = (shape.kind.z & SHAPE_CASTS_CAUSTICS) != 0u;
    uint bits = shape.kind.y | SURFACE_SIDED | (back ? SURFACE_BACK : 0u) | (casts ? SURFACE_CASTS : 0u);
    return SurfaceInteraction(position, 0.0, normal, bits, loadMaterial(shape.kind.y).base.rgb, t, OWNER_SHAPES, hit.z,
                              0u);
}

// The interaction at a hit on splats, of which surface.comp.glsl has stored a part.
SurfaceInteraction splatInteraction(uint index, PathState path, uvec4 hit) {
    uvec4 normal = loadSurfaceTexel(index, 0), albedo = loadSurfaceTexel(index, 1);
    float t = asFloat(albedo.w);
    return SurfaceInteraction(path.origin + t * path.direction, asFloat(hit.y), asVector(normal), normal.w,
                              asVector(albedo), t, hit.w & HIT_OWNER_MASK, hit.z, hit.w >> HIT_TILE_SHIFT);
}

SurfaceInteraction findInteraction(uint index, PathState path, uvec4 hit) {
    if (hit.z == NO_INDEX) return noInteraction();
    if (hit.w == OWNER_SHAPES) return shapeInteraction(path, hit);
    return splatInteraction(index, path, hit);
}

// Whether a hit is on the surroundings of the scene: a studio's floor, a room.
bool isBackdrop(SurfaceInteraction point) {
    return point.owner == OWNER_SHAPES && (loadShape(point.primitive).kind.z & SHAPE_BACKDROP) != 0u;
}

#endif
