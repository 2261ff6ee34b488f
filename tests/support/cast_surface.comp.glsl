// SPDX-License-Identifier: Apache-2.0
// The blended surface at traced hits: first_hits gets normal and t, film.x the radius, film.y 1 on the back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/support/cast_hit.glsl"
#include "shaders/trace/blend.glsl"

void main() {
    uint i;
    uvec4 hit;
    if (!isRay(i) || !castHit(i, hit)) return;
    PathState path = paths[i];
    BlendedSurface surface = surfaceAt(path.origin, path.direction, path.self_t, hit, isSeen(path.bits));
    first_hits[i] = vec4(surface.normal, surface.t);
    film[i] = vec4(surface.radius, surface.back ? 1.0 : 0.0, 0.0, 0.0);
}
