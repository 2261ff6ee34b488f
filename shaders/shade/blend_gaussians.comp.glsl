// SPDX-License-Identifier: Apache-2.0
// Composites the Gaussians that gather_gaussians has gathered in a round, and lists the rays that continue.
// composite_gaussians does the work of both programs for a single instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/shade/gaussian_composite.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/waiting_gaussians.glsl"

void addWaiting(WaitingGaussian next, inout GaussianLight sum) {
    float passes = sum.light.a, alpha = unpackUnorm2x16(next.blue_opacity).y, added = passes * alpha;
    vec3 normal = normalize(splatDirection(uvec4(0u, 0u, next.normal, 0u)));
    vec3 color = vec3(unpackHalf2x16(next.red_green), unpackHalf2x16(next.blue_opacity).x);
    sum.light = vec4(sum.light.rgb + added * color, passes * (1.0 - alpha));
    bool is_middle = kRelights ? added > sum.last.z : passes > kHalf && sum.light.a <= kHalf;
    if (is_middle) sum.middle = vec4(kRelights ? sum.middle.xyz : normal, next.t);
    if (!kRelights) return;
    sum.middle.xyz += added * normal;
    if (is_middle) sum.last.zw = vec2(added, unpackHalf2x16(next.instance).y);
}

void main() {
    uint index;
    pathOfRound(index);
    bool live = index != NO_INDEX;
    uint path = live ? index : 0u, count = live ? waiting_gaussians[path].count : 0u;
    GaussianLight sum = GaussianLight(vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), vec4(vec3(0.0), kWalkEnded));
    if (hasStep(STEP_RESUME)) sum = gaussian_light[path];
    for (uint k = 0u; k < count && passesLight(sum.light.a); k++) addWaiting(waiting_gaussians[path].each[k], sum);

    if (!passesLight(sum.light.a)) sum.light.a = 0.0;
    bool more = count == WAITING_GAUSSIANS && sum.light.a > 0.0, continues = more && !hasStep(STEP_FINAL);
    listForNextRound(continues, path);
    if (!live) return;
    if (more) setLastComposited(path, waiting_gaussians[path].each[WAITING_GAUSSIANS - 1u]);
    if (!continues) {
        sum.light.rgb = decodedLight(sum.light.rgb, sum.light.a, loadHit(path).z == NO_INDEX);
        storeSurface(sum.middle.xyz, sum.last.z, true, sum.last.w, sum.light.rgb, sum.last, sum.middle);
        sum.light = surfaceViewOf(sum.light, sum.middle);
    }
    gaussian_light[path] = sum;
    if (more && !continues) atomicAdd(control.cut_rays, 1u);
}
