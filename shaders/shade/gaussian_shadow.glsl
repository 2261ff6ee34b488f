// SPDX-License-Identifier: Apache-2.0
// What an instance of Gaussians lets pass of a shadow ray.
#ifndef POINTRT_SHADERS_GAUSSIAN_SHADOW_GLSL
#define POINTRT_SHADERS_GAUSSIAN_SHADOW_GLSL
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_transmittance.glsl"

// A ray with negative t_max meets none.
float passedByGaussians(ShadowRay shadow, bool live) {
    bool enters, cut;
    GaussianRay ray = gaussianRay(shadow.origin, shadow.direction, shadow.t_max * cubeScale(), enters);
    float passes = gaussianTransmittance(ray, enters, live && shadow.t_max > 0.0, GAUSSIAN_TRANSMITTANCE_MIN, cut);
    if (cut) atomicAdd(control.cut_rays, 1u);
    return passes;
}

#endif
