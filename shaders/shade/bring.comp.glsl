// SPDX-License-Identifier: Apache-2.0
// The light of the fused form's shadow rays that no target has stopped, where each was asked for those rays alone that
// were sifted for it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film.glsl"
#include "shaders/shade/shadow_ray.glsl"

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    ShadowRay ray = loadShadowRay(path);
    if (ray.t_max >= 0.0) addLight(path, ray.light, ray.scatterings);
}
