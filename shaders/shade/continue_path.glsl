// SPDX-License-Identifier: Apache-2.0
// Continues a path after a hit. Glass splits a ray in two, reflected and refracted: stochastic integrators follow one
// of them, the other integrators defer the second.
#ifndef POINTRT_SHADERS_CONTINUE_PATH_GLSL
#define POINTRT_SHADERS_CONTINUE_PATH_GLSL
#include "shaders/shade/shade_hit.glsl"

const bool kMayDefer = mayRefract && !integratorHas(kIntegrator, INTEGRATOR_IS_STOCHASTIC);

// The ray to follow. defers: whether to defer the other one. If no more rays can be deferred, chooses one of the two at
// random and gives it the weight of both.
NextRay chooseRay(Shading shading, uint bounce, uint index, uint deferred_count, out bool defers) {
    float u = sample2(imagePixel(index), push.sample_index, dimensionPair(bounce, PAIR_CHOICES), params.seed).y;
    float first = luminance(shading.first.weight), second = luminance(shading.second.weight);
    bool both = first > 0.0 && second > 0.0;
    defers = both && deferred_count < MAX_DEFERRED;
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

// Whether the path of a live lane continues, and its state then: the scattered ray, or if there is none the last
// deferred one.
bool continuePath(PathState path, SurfaceInteraction point, Shading shading, uint index, bool live,
                  out PathState next) {
    uint bits = path.bits, bounce = bounceOf(bits), count = bits >> PATH_DEFERRED_SHIFT & PATH_DEFERRED_MASK;
    bool defers = false;
    NextRay ray = kMayDefer ? chooseRay(shading, bounce, index, count, defers) : shading.first;
    bool continues = live && largest(ray.weight) > 0.0, resumes = kMayDefer && live && !continues && count > 0u;
    if (kMayDefer && live && defers)
        deferred[index * MAX_DEFERRED + count] = scatteredPath(point, path, shading.second, count);
    next = scatteredPath(point, path, ray, count + (defers ? 1u : 0u));
    if (kMayDefer && resumes) next = deferred[index * MAX_DEFERRED + count - 1u];
    return continues || resumes;
}

#endif
