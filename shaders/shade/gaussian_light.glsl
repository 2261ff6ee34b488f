// SPDX-License-Identifier: Apache-2.0
// The results of composite_gaussians: the light in front of the hit of a path.
#ifndef POINTRT_SHADERS_GAUSSIAN_LIGHT_GLSL
#define POINTRT_SHADERS_GAUSSIAN_LIGHT_GLSL
#include "shaders/lib/path.glsl"

// Light, weighted by the throughput of the path, and the share that passes.
vec4 loadGaussianLight(uint path) { return kHasGaussians ? gaussian_light[path].light : vec4(0.0, 0.0, 0.0, 1.0); }

// Returns the light that Gaussians add to a path, which keeps the share that passes.
vec3 passGaussians(inout PathState path, vec4 gaussians) {
    if (!kHasGaussians) return vec3(0.0);
    vec3 light = path.throughput * gaussians.rgb;
    path.throughput *= gaussians.a;
    return light;
}

// Coverage and albedo of a pixel whose ray passes through Gaussians before a hit with these values. Gaussians emit what
// they show, so their light counts as albedo, unless the scene lights them.
float coverageBehind(float covered, vec4 gaussians) {
    return kHasGaussians ? 1.0 - gaussians.a * (1.0 - covered) : covered;
}
vec3 albedoBehind(vec3 albedo, vec4 gaussians, uint path) {
    vec3 own = kRelights ? gaussian_light[path].last.yzw : gaussians.rgb;
    return kHasGaussians ? min(own, vec3(1.0)) + gaussians.a * albedo : albedo;
}

#endif
