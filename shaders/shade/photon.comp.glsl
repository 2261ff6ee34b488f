// SPDX-License-Identifier: Apache-2.0
// Photon tracing: at a hit, mirrors and glass reflect or refract a photon; a surface that scatters light stores it if
// it came from a mirror or glass.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shade/make_bsdf.glsl"
#include "shaders/lib/sampler.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shade/scattered_path.glsl"
#include "shaders/lib/append.glsl"

// Each photon is emitted towards one target. Other targets get photons of their own, so a photon that first hits
// another target does not count.
bool hitsTarget(PathState path, SurfaceInteraction point) {
    uint target = point.owner | (point.owner == OWNER_SHAPES ? point.primitive << PHOTON_SHAPE_SHIFT : 0u);
    return path.target == target;
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u;
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction point = findInteraction(index, path, hit);
    uint bits = path.bits, bounce = bounceOf(bits);
    resolveSides(point, path);
    bool back = isBack(point);
    Material row = interfaceMaterial(point, path);
    vec3 normal = point.normal, view = -path.direction;
    Bsdf bsdf = materialBsdf(row, point.albedo, back, dot(normal, view));
    vec3 flux = path.throughput * (back ? transmittance(row, point.t) : vec3(1.0));

    float u = sample1(index, push.sample_index, bounce, params.seed);
    bool reflects = u < bsdf.reflect_chance, refracts = !reflects && u < bsdf.reflect_chance + bsdf.refract_chance;
    bool counts = live && point.t >= 0.0 && (bounce > 0u || hitsTarget(path, point));
    bool stored = counts && !reflects && !refracts && bounce > 0u && hasSmoothLobe(bsdf);
    if (stored) {
        float chance = 1.0 - bsdf.reflect_chance - bsdf.refract_chance;
        photons[index] = Photon(vec4(point.position, uintBitsToFloat(packSnorm4x8(vec4(normal, 0.0)))), vec4(flux / chance, 1.0));
    }
    // radiance is transported without the factor eta^2 at boundaries (setGlass), so it is applied to the flux instead
    float boundary = bsdf.thin ? 1.0 : bsdf.eta * bsdf.eta;
    NextRay ray = NextRay(refracts ? refractedThrough(bsdf, normal, view) : reflect(-view, normal),
                          flux * (refracts ? bsdf.albedo * boundary : bsdf.reflect_tint), 0.0);
    bool continues = counts && (reflects || refracts) && bounce < params.bounces && largest(ray.weight) > 0.0;
    appendRay(continues, index, scatteredPath(point, path, ray, 0u));
}
