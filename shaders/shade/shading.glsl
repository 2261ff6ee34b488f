// SPDX-License-Identifier: Apache-2.0
// What an integrator answers.
#ifndef POINTRT_SHADERS_SHADING_GLSL
#define POINTRT_SHADERS_SHADING_GLSL

struct NextRay {
    vec3 direction;
    vec3 weight; // the path's throughput along it; 0: there is none
    float pdf;   // of its choice over solid angle, 0 where there was no other (mirrors, glass)
};

struct Shading {
    vec3 added;      // radiance that needs no further ray
    vec3 direct_weight; // of the light that shadow rays may bring; 0: none is asked for
    NextRay first;
    NextRay second;
};

NextRay noRay() { return NextRay(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0); }

Shading onlyLight(vec3 added) { return Shading(added, vec3(0.0), noRay(), noRay()); }

// Of light that came t through a material; a pane has no inside, and nothing has that is not glass.
vec3 transmittance(Material row, float t) {
    return isThin(row) || !mayRefract ? vec3(1.0) : exp(-row.absorption.rgb * max(t, 0.0));
}

#endif
