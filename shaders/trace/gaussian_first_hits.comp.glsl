// SPDX-License-Identifier: Apache-2.0
// First hits of an instance of Gaussians: depth, normal and ids (AOVs) of the rays through pixel centres. A ray hits
// the Gaussian behind which less than half of the light passes, if no surface is nearer. Its id is that of the Gaussian
// that adds most to the pixel up to there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_hits.glsl"
#include "shaders/shared/film_parts.h"

const float kHalf = 0.5;

// The flattest axis, towards the eye; in render space.
vec3 gaussianNormal(uint gaussian, vec3 direction) {
    vec3 x = loadGaussianRow(gaussian, 0u).xyz, y = loadGaussianRow(gaussian, 1u).xyz;
    vec3 z = loadGaussianRow(gaussian, 2u).xyz;
    // rows are axes over their half lengths: the longest belongs to the shortest axis
    vec3 flattest = dot(x, x) > dot(y, y) ? x : y;
    flattest = dot(flattest, flattest) > dot(z, z) ? flattest : z;
    return renderDirection(normalize(dot(flattest, direction) > 0.0 ? -flattest : flattest));
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX, enters;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(live ? index : 0u));
    float surface = live ? first_hits[at].w : 0.0;
    float t_max = (surface >= 0.0 ? surface : 1e30) * cubeScale();
    GaussianRay ray = gaussianRay(path.origin, path.direction, t_max, enters);
    GaussianHits hits = startGaussianHits(ray, enters);
    GaussianHit strongest = kNoGaussianHit, middle = kNoGaussianHit;
    float transmittance = 1.0, most = 0.0;
    bool going;
    do {
        going = live && mayGoOn(hits) && transmittance > kHalf;
        GaussianHit hit = nextHit(hits, enters, going);
        bool is_hit = hit.gaussian != NO_INDEX;
        float alpha = is_hit ? alphaAt(loadGaussianRow(hit.gaussian, 3u).x, hit.distance_squared) : 0.0;
        bool stronger = transmittance * alpha > most;
        if (stronger) strongest = hit;
        if (stronger) most = transmittance * alpha;
        transmittance *= 1.0 - alpha;
        if (is_hit && transmittance <= kHalf) middle = hit;
    } while (going);
    if (middle.gaussian == NO_INDEX) return;
    first_hits[at] = vec4(gaussianNormal(middle.gaussian, ray.direction), (ray.t_start + middle.t) / cubeScale());
    uvec3 ids = uvec3(strongest.gaussian, instance.materials.xy);
    first_hits[at + 1u] = vec4(uintBitsToFloat(ids), 1.0);
}
