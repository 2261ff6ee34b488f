// SPDX-License-Identifier: Apache-2.0
// What the integrators make of a path's hit: light that needs no further ray, a point that asks for light, and the rays
// that go on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/surface_interaction.glsl"
#include "shaders/material/make_bsdf.glsl"
#include "shaders/film/film.glsl"
#include "shaders/light/sky.glsl"
#include "shaders/integrator/next_path.glsl"
#include "shaders/frame/append.glsl"
#include "shaders/integrator/shade_classic.glsl"
#include "shaders/integrator/shade_path.glsl"
#include "shaders/integrator/shade_view.glsl"

// What refracts sends on two rays at once, one of which integrators by chance follow.
#define REFRACTS(number, NAME, Name, word, label, lobes, traits)                                                       \
    | (((traits) & MATERIAL_REFRACTS) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool kMayRefract = (kFeatures & (0u MATERIALS(REFRACTS))) != 0u;
const bool kMayDefer = kMayRefract && !integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE);

void appendLightQuery(bool wants, uint index, SurfaceInteraction point, vec3 view, vec3 weight, uint bounce) {
    appendEntry(APPEND_LIGHT_QUERY, wants, index);
    if (!wants) return;
    uint material = point.bits & (SURFACE_MATERIAL_MASK | SURFACE_REACH_MASK << SURFACE_REACH_SHIFT);
    light_queries[index] = DirectLightQuery(point.position, point.radius, point.normal, material, point.albedo,
                                            point.owner, weight, bounce, view, isBack(point) ? -1.0 : 1.0);
}

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

// The scene itself is what covers a pixel.
bool covers(SurfaceInteraction point) {
    bool backdrop = point.owner == OWNER_SHAPES && (loadShape(point.primitive).kind.z & SHAPE_BACKDROP) != 0u;
    return point.t >= 0.0 && !backdrop;
}

// The numbers of SHADINGS, and that of each integrator in one number.
#define SHADING_NUMBER(number, NAME, function) const uint SHADING_##NAME = number;
SHADINGS(SHADING_NUMBER)
#define SHADING_OF_ROW(number, Name, word, label, SHADING, traits) | SHADING_##SHADING << (INTEGRATOR_BITS * number)
const uint kShadings = 0u INTEGRATORS(SHADING_OF_ROW);
const uint kShading = kShadings >> (INTEGRATOR_BITS * kIntegrator) & ((1u << INTEGRATOR_BITS) - 1u);

// As the integrator does that the program is built for.
Shading shadeHit(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
#define SHADE(number, NAME, function) \
    if (kShading == number) return function(path, point, row, bsdf, pixel);
    SHADINGS(SHADE)
    return onlyLight(vec3(0.0));
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
    appendLightQuery(live && largest(shading.direct_weight) > 0.0 && params.light_count > 0u, index, point,
                     -path.direction, shading.direct_weight, bounce);

    if (mayGoOn()) goOn(path, point, shading, index, live);
}
