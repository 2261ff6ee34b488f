// SPDX-License-Identifier: Apache-2.0
// First hits among several instances of Gaussians, from those that gather_gaussians has gathered in a round. See
// gaussian_first_hits for a single instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/trace/gaussian_first_hit.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/waiting_gaussians.glsl"
#include "shaders/trace/gaussian_rounds.glsl"

// GaussianLight between rounds: light.x is the most that one Gaussian adds, last.xyz the ids of that Gaussian, and
// light.a as always.
void meetWaiting(WaitingGaussian next, inout GaussianLight sum) {
    float alpha = unpackUnorm2x16(next.blue_opacity).y, added = sum.light.a * alpha;
    uvec3 ids = uvec3(next.gaussian, next.red_green, next.blue_opacity & 0xFFFFu);
    if (added > sum.light.x) sum.last.xyz = uintBitsToFloat(ids);
    sum.light.x = max(sum.light.x, added);
    sum.light.a *= 1.0 - alpha;
    vec3 normal = normalize(splatDirection(uvec4(0u, 0u, next.normal, 0u)));
    if (sum.light.a <= kHalf) sum.middle = vec4(normal, next.t);
}

void main() {
    uint index;
    pathOfRound(index);
    bool live = index != NO_INDEX;
    uint path = live ? index : 0u, count = live ? waiting_gaussians[path].count : 0u;
    GaussianLight sum = GaussianLight(vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), vec4(vec3(0.0), kWalkEnded));
    if (hasStep(STEP_RESUME)) sum = gaussian_light[path];
    for (uint k = 0u; k < count && sum.light.a > kHalf; k++) meetWaiting(waiting_gaussians[path].each[k], sum);

    bool continues = count == WAITING_GAUSSIANS && sum.light.a > kHalf && !hasStep(STEP_FINAL);
    listForNextRound(continues, path);
    if (!live) return;
    if (continues) setLastComposited(path, waiting_gaussians[path].each[WAITING_GAUSSIANS - 1u]);
    gaussian_light[path] = sum;
    if (sum.middle.w >= kWalkEnded) return;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(path));
    first_hits[at] = sum.middle;
    first_hits[at + 1u] = vec4(sum.last.xyz, 1.0);
}
