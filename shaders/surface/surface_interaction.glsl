// SPDX-License-Identifier: Apache-2.0
// What a path has met, whoever owns it.
#ifndef POINTRT_SHADERS_SURFACE_INTERACTION_GLSL
#define POINTRT_SHADERS_SURFACE_INTERACTION_GLSL
#include "shaders/frame/path.glsl"
#include "shaders/trace/shapes.glsl"

struct SurfaceInteraction {
    float t; // negative: nothing is hit
    vec3 position;
    vec3 normal; // towards the viewer
    float radius; // 0 on shapes
    uint owner;
    uint splat;    // or shape
    uint material;
    bool sided;    // whether normals tell inside from outside; scans without oriented normals do not
    bool back;     // seen from the inside
    bool casts;    // caustics: photons go by way of it
    vec3 albedo;
};

SurfaceInteraction noInteraction() {
    return SurfaceInteraction(-1.0, vec3(0.0), vec3(0.0), 0.0, NO_OWNER, NO_INDEX, 0u, true, false, false, vec3(0.0));
}

SurfaceInteraction shapeInteraction(PathState path, uvec4 hit) {
    Shape shape = loadShape(hit.z);
    float t = uintBitsToFloat(hit.x);
    vec3 position = path.origin.xyz + t * path.direction.xyz;
    bool back;
    vec3 normal = shapeNormal(shape, position, path.direction.xyz, back);
    return SurfaceInteraction(t, position, normal, 0.0, OWNER_SHAPES, hit.z, shape.kind.y, true, back,
                              (shape.kind.z & SHAPE_CASTS_CAUSTICS) != 0u, loadMaterial(shape.kind.y).base.rgb);
}

SurfaceInteraction splatInteraction(uint index) {
    SurfacePoint s = SurfacePoint(loadSurfaceTexel(index, 0), loadSurfaceTexel(index, 1), loadSurfaceTexel(index, 2),
                                  floatBitsToUint(loadSurfaceTexel(index, 3)));
    uint bits = floatBitsToUint(s.normal.w);
    return SurfaceInteraction(s.albedo.w, s.position.xyz, s.normal.xyz, s.position.w, s.id.y, s.id.x,
                              bits & SURFACE_MATERIAL_MASK, (bits & SURFACE_SIDED) != 0u, (bits & SURFACE_BACK) != 0u,
                              s.id.z != 0u, s.albedo.rgb);
}

SurfaceInteraction findInteraction(uint index, PathState path, uvec4 hit) {
    if (hit.z == NO_INDEX) return noInteraction();
    if (hit.w == OWNER_SHAPES) return shapeInteraction(path, hit);
    return splatInteraction(index);
}

#endif
