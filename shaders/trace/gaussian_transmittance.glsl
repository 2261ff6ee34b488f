// SPDX-License-Identifier: Apache-2.0
// The transmittance of Gaussians along a ray.
#ifndef POINTRT_SHADERS_GAUSSIAN_TRANSMITTANCE_GLSL
#define POINTRT_SHADERS_GAUSSIAN_TRANSMITTANCE_GLSL
#include "shaders/trace/gaussian_hits.glsl"

// The share of light that passes; 0 if less than `least`. The order of Gaussians does not matter. cut: not all
// Gaussians were tested, as in compositeAlong (composite_gaussians.comp.glsl).
float gaussianTransmittance(GaussianRay ray, bool enters, bool live, float least, out bool cut) {
    GaussianHits hits = startGaussianHits(ray, enters);
    float transmittance = 1.0;
    bool going;
    do {
        going = live && transmittance >= least && !hasWalked(hits);
        nextList(hits, going);
        GaussianHit hit = nextPeak(hits, going);
        bool is_hit = hit.gaussian != NO_INDEX;
        float opacity = loadGaussianRow(is_hit ? hit.gaussian : 0u, 3u).x;
        transmittance *= is_hit ? 1.0 - alphaAt(opacity, hit.distance_squared) : 1.0;
    } while (going);
    cut = live && transmittance >= least && !hasWalked(hits);
    return transmittance < least ? 0.0 : transmittance;
}

#endif
