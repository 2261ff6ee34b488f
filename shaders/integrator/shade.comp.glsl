// SPDX-License-Identifier: Apache-2.0
// What the integrators make of a path's hit: light that needs no further ray, a point that asks for light, and the rays
// that go on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/integrator/shade_hit.glsl"
#include "shaders/film/film.glsl"
#include "shaders/frame/append.glsl"

// What refracts sends on two rays at once, one of which integrators by chance follow.
#define REFRACTS(number, NAME, Name, word, label, lobes, traits)                                                       \
    | (((traits) & MATERIAL_REFRACTS) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool kMayRefract = (kFeatures & (0u MATERIALS(REFRACTS))) != 0u;
const bool kMayDefer = kMayRefract && !integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE);

// Of two rays one is followed and the other waits; where no more can wait, chance takes one of them for both.
NextRay followed(Shading shading, uint bounce, uint index, uint waiting, out bool defers) {
    float u = sample2(imagePixel(index), push.sample_index, dimensionPair(bounce, PAIR_CHOICES), params.seed).y;
    float first = luminance(shading.first.weight), second = luminance(shading.second.weight);
    bool both = first > 0.0 && second > 0.0;
    defers = both && waiting < MAX_DEFERRED;
    if (!both || defers) {
        if (first > 0.0) return shading.first;
        return shading.second;
    }
    float chance = first / (first + second);
    NextRay chosen = shading.second;
    if (u < chance) chosen = shading.first;
    chosen.weight /= u < chance ? chance : 1.0 - chance;
    return chosen;
}

// Queues the path's next ray: of two the other one waits, and where there is none, the last that waited is taken up.
void goOn(PathState path, SurfaceInteraction point, Shading shading, uint index, bool live) {
    uint bits = path.bits, bounce = bounceOf(bits), waiting = bits >> PATH_DEFERRED_SHIFT & PATH_DEFERRED_MASK;
    bool defers = false;
    NextRay next = kMayDefer ? followed(shading, bounce, index, waiting, defers) : shading.first;
    bool goes_on = live && largest(next.weight) > 0.0, resumes = kMayDefer && live && !goes_on && waiting > 0u;
    if (kMayDefer && live && defers) deferred[index * MAX_DEFERRED + waiting] = pathAfter(point, path, shading.second, waiting);
    PathState after = pathAfter(point, path, next, waiting + (defers ? 1u : 0u));
    if (kMayDefer && resumes) after = deferred[index * MAX_DEFERRED + waiting - 1u];
    appendRay(goes_on || resumes, index, after);
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes work along: the appends below need the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction point = findInteraction(index, path, hit);
    uint bits = path.bits, bounce = bounceOf(bits);
    bool covered = covers(point);
    vec3 albedo = covered ? point.albedo : vec3(0.0);
    // glass is left where the surface is met from behind; where normals do not tell, every second time
    settleSides(point, path);
    bool back = isBack(point);
    Material row = loadMaterial(materialOf(point));
    Bsdf bsdf = makeBsdf(row, point.albedo, back, -dot(point.normal, path.direction));
    path.throughput *= back ? transmittance(row, point.t) : vec3(1.0);
    Shading shading = shadeHit(path, point, row, bsdf, imagePixel(index));
    if (live && kCameraPass) beginSample(index, push.sample_index == 0u, shading.added, covered ? 1.0 : 0.0, albedo);
    if (live && !kCameraPass) addLight(index, shading.added, bounce);
    bool asks = live && asksForLight(shading);
    appendEntry(APPEND_LIGHT_QUERY, asks, index);
    if (asks) light_queries[index] = lightQuery(point, -path.direction, shading.direct_weight, bounce);

    if (mayGoOn()) goOn(path, point, shading, index, live);
}
