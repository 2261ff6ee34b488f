// SPDX-License-Identifier: Apache-2.0
// The transmittance of an instance of Gaussians along a shadow ray.
#ifndef POINTRT_SHADERS_GAUSSIAN_SHADOW_GLSL
#define POINTRT_SHADERS_GAUSSIAN_SHADOW_GLSL
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_transmittance.glsl"

// The share of light that an instance of Gaussians lets pass. A ray with negative t_max hits nothing.
float passedByGaussians(ShadowRay shadow, bool live) {
    bool enters, cut;
    // rays from lit Gaussians, the only ones without an owner, must not hit their own surface
    float start = kRelights && shadow.owner == NO_OWNER ? shadow.self_t : 0.0, t_max = shadow.t_max - start;
    vec3 origin = kRelights ? shadow.origin + start * shadow.direction : shadow.origin;
    GaussianRay ray = gaussianRay(origin, shadow.direction, t_max * cubeScale(), enters);
    float passes = gaussianTransmittance(ray, enters, live && t_max > 0.0, GAUSSIAN_TRANSMITTANCE_MIN, cut);
    if (cut) atomicAdd(control.cut_rays, 1u);
    return passes;
}

#endif
