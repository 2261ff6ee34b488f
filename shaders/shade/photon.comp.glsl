// SPDX-License-Identifier: Apache-2.0
// What becomes of photons at what they have hit: mirrors and glass send them on, a surface that scatters light keeps
// those that came by way of such.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shade/make_bsdf.glsl"
#include "shaders/lib/sampler.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shade/next_path.glsl"
#include "shaders/lib/append.glsl"

// Photons are sent to one thing each. What else they meet on the way they are sent to as well, apart.
bool meetsTarget(PathState path, SurfaceInteraction point) {
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
    settleSides(point, path);
    bool back = isBack(point);
    Material row = loadMaterial(materialOf(point));
    vec3 normal = point.normal, way_back = -path.direction;
    Bsdf bsdf = materialBsdf(row, point.albedo, back, dot(normal, way_back));
    vec3 flux = path.throughput * (back ? transmittance(row, point.t) : vec3(1.0));

    float u = sample1(index, push.sample_index, bounce, params.seed);
    bool reflects = u < bsdf.reflect_chance, refracts = !reflects && u < bsdf.reflect_chance + bsdf.refract_chance;
    bool met = live && point.t >= 0.0 && (bounce > 0u || meetsTarget(path, point));
    bool stays = met && !reflects && !refracts && bounce > 0u && hasSmoothLobe(bsdf);
    if (stays) {
        float chance = 1.0 - bsdf.reflect_chance - bsdf.refract_chance;
        photons[index] = Photon(vec4(point.position, uintBitsToFloat(packSnorm4x8(vec4(normal, 0.0)))), vec4(flux / chance, 1.0));
    }
    // as radiance is carried over boundaries without its factor, so is light that ends or starts in glass
    float boundary = bsdf.thin ? 1.0 : bsdf.eta * bsdf.eta;
    NextRay ray = NextRay(refracts ? refractedWay(bsdf, normal, way_back) : reflect(-way_back, normal),
                          flux * (refracts ? bsdf.albedo * boundary : bsdf.reflect_tint), 0.0);
    bool goes_on = met && (reflects || refracts) && bounce < params.bounces && largest(ray.weight) > 0.0;
    appendRay(goes_on, index, pathAfter(point, path, ray, 0u));
}
