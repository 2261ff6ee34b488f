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

// What a ray has met so far.
struct FirstHit {
    GaussianHit middle;    // behind which less than half of the light passes
    GaussianHit strongest; // adds most
    float most;
    float transmittance;
};

void meetGaussian(inout FirstHit first, GaussianHit hit) {
    bool is_hit = hit.gaussian != NO_INDEX;
    float alpha = is_hit ? alphaAt(loadGaussianRow(is_hit ? hit.gaussian : 0u, 3u).x, hit.distance_squared) : 0.0;
    float added = first.transmittance * alpha;
    bool stronger = added > first.most;
    if (stronger) first.strongest = hit;
    if (stronger) first.most = added;
    first.transmittance *= 1.0 - alpha;
    if (is_hit && first.transmittance <= kHalf) first.middle = hit;
}

FirstHit firstHitAlong(GaussianRay ray, bool enters, bool live) {
    GaussianHits hits = startGaussianHits(ray, enters);
    FirstHit first = FirstHit(kNoGaussianHit, kNoGaussianHit, 0.0, 1.0);
    bool going, lives = live;
    do {
        do {
            going = lives && mayGoOn(hits) && first.transmittance > kHalf;
            meetGaussian(first, nextHit(hits, going));
        } while (going);
        lives = restartIfLost(hits, enters, lives && first.transmittance > kHalf);
    } while (lives);
    return first;
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX, enters;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(live ? index : 0u));
    float surface = live ? first_hits[at].w : 0.0;
    float t_max = (surface >= 0.0 ? surface : 1e30) * cubeScale();
    GaussianRay ray = gaussianRay(path.origin, path.direction, t_max, enters);
    FirstHit first = firstHitAlong(ray, enters, live);
    if (first.middle.gaussian == NO_INDEX) return;
    float t = (ray.t_start + first.middle.t) / cubeScale();
    first_hits[at] = vec4(gaussianNormal(first.middle.gaussian, ray.direction), t);
    uvec3 ids = uvec3(first.strongest.gaussian, instance.materials.xy);
    first_hits[at + 1u] = vec4(uintBitsToFloat(ids), 1.0);
}
