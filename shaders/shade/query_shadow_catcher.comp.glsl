// SPDX-License-Identifier: Apache-2.0
// Gaussians as a shadow catcher: objects placed among them cast shadows on the captured light. Queries the direct light
// at the points where rays have lost half of their light to Gaussians or, if the scene lights Gaussians, at the
// Gaussian that adds most.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/gaussian_end.glsl"
#include "shaders/lib/append.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes take part: appending needs the whole subgroup
    vec4 middle = gaussian_light[index].middle;
    bool catches = live && middle.w < kWalkEnded;
    appendEntry(LIST_DIRECT_LIGHT, catches, index);
    vec3 position = path.origin + middle.w * path.direction;
    float radius = kRelights ? length(middle.xyz) : 0.0;
    vec3 normal = kRelights ? middle.xyz / radius : middle.xyz;
    if (catches)
        light_queries[index] = DirectLightQuery(position, radius, normal, 0u, vec3(1.0), NO_OWNER, vec3(1.0),
                                                bounceOf(path.bits), -path.direction, 1.0);
}
