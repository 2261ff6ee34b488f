// SPDX-License-Identifier: Apache-2.0
// Path tracing: at each hit one BSDF sample and one light sample (next event estimation), combined by multiple
// importance sampling with the balance heuristic (Veach, Robust Monte Carlo Methods for Light Transport Simulation,
// 1997).
#ifndef POINTRT_SHADERS_SHADE_PATH_GLSL
#define POINTRT_SHADERS_SHADE_PATH_GLSL
#include "shaders/lib/sampler.glsl"
#include "shaders/shade/lights.glsl"

// Bounces before Russian roulette: the first ones carry most of the light.
const uint kFirstRoulette = 3u;

// Emission at the hit, with the MIS weight of a BSDF sample that hits a light.
vec3 emissionSeen(PathState path, Material row) {
    uint light = floatBitsToUint(row.emission.w);
    float scatter_pdf = path.pdf;
    if (light != NO_LIGHT && (path.bits & PATH_CAUSTIC) != 0u) return vec3(0.0);
    if (light == NO_LIGHT || scatter_pdf == 0.0) return row.emission.rgb;
    float light_pdf = lightPdf(loadLight(light), path.origin, path.direction) / float(params.light_count);
    return row.emission.rgb * (scatter_pdf / (scatter_pdf + light_pdf));
}

// Russian roulette: ends a path with a probability that rises as its throughput falls, and scales up survivors.
vec3 roulette(vec3 throughput, uint bounce, float u) {
    float survival = bounce < kFirstRoulette ? 1.0 : min(largest(throughput), 0.95);
    return u < survival ? throughput / survival : vec3(0.0);
}

Shading shadePath(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 throughput = path.throughput, view = -path.direction;
    if (point.t < 0.0) return onlyRadiance(throughput * skySeen(path));
    uint bounce = bounceOf(path.bits);
    vec3 radiance = throughput * emissionSeen(path, row);
    vec2 u = sample2(pixel, push.sample_index, dimensionPair(bounce, PAIR_DIRECTION), params.seed);
    vec2 choices = sample2(pixel, push.sample_index, dimensionPair(bounce, PAIR_CHOICES), params.seed);
    Scattering scattered = sampleBsdf(bsdf, point.normal, view, vec3(u, choices.x));
    bool last = bounce >= ofLane(params.bounces);
    vec3 weight = last ? vec3(0.0) : roulette(throughput * scattered.weight, bounce, choices.y);
    vec3 direct_weight = hasSmoothLobe(bsdf) ? throughput : vec3(0.0);
    return Shading(radiance, direct_weight, NextRay(scattered.direction, weight, scattered.pdf), noRay());
}

#endif
