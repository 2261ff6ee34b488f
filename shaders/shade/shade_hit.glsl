// SPDX-License-Identifier: Apache-2.0
// Shading of a path's hit by the integrator, for megakernel and wavefront programs.
#ifndef POINTRT_SHADERS_SHADE_HIT_GLSL
#define POINTRT_SHADERS_SHADE_HIT_GLSL
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shade/make_bsdf.glsl"
#include "shaders/shade/sky.glsl"
#include "shaders/shade/scattered_path.glsl"
#include "shaders/shade/shade_ambient.glsl"
#include "shaders/shade/shade_classic.glsl"
#include "shaders/shade/shade_path.glsl"
#include "shaders/shade/shade_view.glsl"

// Whether the hit covers the pixel: hits on the scene do, hits on its surroundings do not.
bool covers(SurfaceInteraction point) { return point.t >= 0.0 && !isBackdrop(point); }

// Calls the shading function of the integrator that the program is built for.
Shading shadeHit(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
#define SHADE(number, NAME, function) \
    if (kShading == number) return function(path, point, row, bsdf, pixel);
    SHADINGS(SHADE)
    return onlyRadiance(vec3(0.0));
}

// A shaded hit.
struct ShadedHit {
    SurfaceInteraction point; // with resolved sides
    Material row;
    Bsdf bsdf;
    Shading shading;
};

// A hit from behind means that the path leaves glass; without oriented normals, every second hit does.
ShadedHit shadeAt(PathState path, SurfaceInteraction point, uint index) {
    resolveSides(point, path);
    bool back = isBack(point);
    Material row = interfaceMaterial(point, path);
    Bsdf bsdf = makeBsdf(row, point.albedo, back, -dot(point.normal, path.direction));
    path.throughput *= back ? transmittance(row, point.t) : vec3(1.0);
    return ShadedHit(point, row, bsdf, shadeHit(path, point, row, bsdf, imagePixel(index)));
}

// The direct-lighting query of a hit.
DirectLightQuery lightQuery(SurfaceInteraction point, vec3 view, vec3 weight, uint bounce) {
    uint material = point.bits & (SURFACE_MATERIAL_MASK | SURFACE_SELF_REACH_MASK << SURFACE_SELF_REACH_SHIFT);
    return DirectLightQuery(point.position, point.radius, point.normal, material, point.albedo, point.owner, weight,
                            bounce, view, isBack(point) ? -1.0 : 1.0);
}

bool needsDirectLight(Shading shading) { return largest(shading.direct_weight) > 0.0 && params.light_count > 0u; }

#endif
