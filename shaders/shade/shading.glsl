// SPDX-License-Identifier: Apache-2.0
// The result of shading a hit.
#ifndef POINTRT_SHADERS_SHADING_GLSL
#define POINTRT_SHADERS_SHADING_GLSL

struct NextRay {
    vec3 direction;
    vec3 weight; // throughput of the path along it; 0: no ray
    float pdf;   // over solid angle; 0: a delta distribution (mirrors, glass)
};

struct Shading {
    vec3 radiance;      // emission and background: needs no further ray
    vec3 direct_weight; // throughput of direct light; 0: no next event estimation
    NextRay first;
    NextRay second;
};

NextRay noRay() { return NextRay(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0); }

Shading onlyRadiance(vec3 radiance) { return Shading(radiance, vec3(0.0), noRay(), noRay()); }

// Transmittance over a distance t inside a material; 1 for panes and for all but glass.
vec3 transmittance(Material row, float t) {
    return isThin(row) || !mayRefract ? vec3(1.0) : exp(-row.absorption.rgb * max(t, 0.0));
}

#endif
