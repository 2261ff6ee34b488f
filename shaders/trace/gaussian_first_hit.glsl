// SPDX-License-Identifier: Apache-2.0
// The first hit of a ray among Gaussians: the one behind which less than half of the light passes.
#ifndef POINTRT_SHADERS_GAUSSIAN_FIRST_HIT_GLSL
#define POINTRT_SHADERS_GAUSSIAN_FIRST_HIT_GLSL
#include "shaders/trace/gaussian_hits.glsl"

// A ray hits Gaussians where they have absorbed this share of the light.
const float kHalf = 0.5;

// The shortest axis, of any length, turned against the direction; both in the cube.
vec3 gaussianNormal(uint gaussian, vec3 direction) {
    vec3 x = loadGaussianRow(gaussian, 0u).xyz, y = loadGaussianRow(gaussian, 1u).xyz;
    vec3 z = loadGaussianRow(gaussian, 2u).xyz;
    // each row is an axis divided by its half length, so the longest row belongs to the shortest axis
    vec3 flattest = dot(x, x) > dot(y, y) ? x : y;
    flattest = dot(flattest, flattest) > dot(z, z) ? flattest : z;
    return dot(flattest, direction) > 0.0 ? -flattest : flattest;
}

// The hits of a ray so far.
struct FirstHit {
    GaussianHit middle;    // behind which less than half of the light passes
    GaussianHit strongest; // the one that adds most
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
            going = lives && mayContinue(hits) && first.transmittance > kHalf;
            meetGaussian(first, nextHit(hits, going));
        } while (going);
        lives = restartIfLost(hits, enters, lives && first.transmittance > kHalf);
    } while (lives);
    return first;
}

#endif
