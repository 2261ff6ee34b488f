// SPDX-License-Identifier: Apache-2.0
// The surface at traced hits, as shading sees it: first_hits gets normal and t, film.x the radius around.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame/bindings.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/surface/blend.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= control.queued[0]) return;
    uvec4 hit = loadHit(i);
    if (hit.z == NO_INDEX) return;
    BlendedSurface surface = surfaceAt(paths[i].origin, paths[i].direction, hit);
    first_hits[i] = vec4(surface.normal, surface.t);
    film[i] = vec4(surface.radius);
}
