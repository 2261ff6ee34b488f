// SPDX-License-Identifier: Apache-2.0
// What the integrators make of a path's hit: light that needs no further ray, a point that asks for light, and the rays
// that go on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/go_on.glsl"
#include "shaders/shade/film.glsl"
#include "shaders/lib/append.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes work along: the appends below need the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction point = findInteraction(index, path, hit);
    uint bounce = bounceOf(path.bits);
    bool covered = covers(point);
    vec3 albedo = covered ? point.albedo : vec3(0.0);
    ShadedHit shaded = shadeAt(path, point, index);
    Shading shading = shaded.shading;
    if (live && kCameraPass) beginSample(index, push.sample_index == 0u, shading.added, covered ? 1.0 : 0.0, albedo);
    if (live && !kCameraPass) addLight(index, shading.added, bounce);
    bool asks = live && asksForLight(shading);
    appendEntry(LIST_LIT, asks, index);
    if (asks) light_queries[index] = lightQuery(shaded.point, -path.direction, shading.direct_weight, bounce);

    PathState after;
    if (mayGoOn()) appendRay(nextPath(path, shaded.point, shading, index, live, after), index, after);
}
