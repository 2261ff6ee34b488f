// SPDX-License-Identifier: Apache-2.0
// The ray that a path goes on with. What refracts sends on two rays at once, one of which integrators by chance follow;
// with others, of the two one waits.
#ifndef POINTRT_SHADERS_GO_ON_GLSL
#define POINTRT_SHADERS_GO_ON_GLSL
#include "shaders/shade/shade_hit.glsl"

const bool kMayDefer = mayRefract && !integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE);

// Of two rays one is followed and the other waits; where no more can wait, chance takes one of them for both.
NextRay followed(Shading shading, uint bounce, uint index, uint waiting, out bool defers) {
    float u = sample2(imagePixel(index), push.sample_index, dimensionPair(bounce, PAIR_CHOICES), params.seed).y;
    float first = luminance(shading.first.weight), second = luminance(shading.second.weight);
    bool both = first > 0.0 && second > 0.0;
    defers = both && waiting < MAX_DEFERRED;
    if (!both || defers) {
        if (first > 0.0) return shading.first;
        return shading.second;
    }
    float chance = first / (first + second);
    NextRay chosen = shading.second;
    if (u < chance) chosen = shading.first;
    chosen.weight /= u < chance ? chance : 1.0 - chance;
    return chosen;
}

// Whether the path of a live lane goes on, and its state then: of two rays the other one waits, and where there is none,
// the last that waited is taken up.
bool nextPath(PathState path, SurfaceInteraction point, Shading shading, uint index, bool live, out PathState after) {
    uint bits = path.bits, bounce = bounceOf(bits), waiting = bits >> PATH_DEFERRED_SHIFT & PATH_DEFERRED_MASK;
    bool defers = false;
    NextRay next = kMayDefer ? followed(shading, bounce, index, waiting, defers) : shading.first;
    bool goes_on = live && largest(next.weight) > 0.0, resumes = kMayDefer && live && !goes_on && waiting > 0u;
    if (kMayDefer && live && defers) deferred[index * MAX_DEFERRED + waiting] = pathAfter(point, path, shading.second, waiting);
    after = pathAfter(point, path, next, waiting + (defers ? 1u : 0u));
    if (kMayDefer && resumes) after = deferred[index * MAX_DEFERRED + waiting - 1u];
    return goes_on || resumes;
}

#endif
