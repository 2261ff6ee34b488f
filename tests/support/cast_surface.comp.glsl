// SPDX-License-Identifier: Apache-2.0
// The surface at traced hits, as shading sees it: first_hits gets normal and t, film.x the radius around, film.y 1 where it is a back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/support/cast_hit.glsl"
#include "shaders/trace/blend.glsl"

void main() {
    uint i;
    uvec4 hit;
    if (!isRay(i) || !castHit(i, hit)) return;
    BlendedSurface surface = surfaceAt(paths[i].origin, paths[i].direction, paths[i].own_t, hit, isSeen(paths[i].bits));
    first_hits[i] = vec4(surface.normal, surface.t);
    film[i] = vec4(surface.radius, surface.back ? 1.0 : 0.0, 0.0, 0.0);
}
