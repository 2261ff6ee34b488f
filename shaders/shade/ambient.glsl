// SPDX-License-Identifier: Apache-2.0
// Integrator ambient: light from bright surroundings, as far as nearby surfaces do not block it (ambient occlusion;
// Zhukov et al., An Ambient Light Illumination Model, 1998). A hit takes one short shadow ray.
#ifndef POINTRT_SHADERS_AMBIENT_GLSL
#define POINTRT_SHADERS_AMBIENT_GLSL
#include "shaders/shade/lights.glsl"
#include "shaders/shade/sky.glsl"

const bool kIsAmbient = integratorHas(kIntegrator, INTEGRATOR_IS_AMBIENT);

// The largest distance at which surfaces occlude, in picture heights, so that hollows are equally dark at every zoom.
// The lengths of rays are spread up to this distance, so that occlusion fades with distance.
const float kReachShare = 0.25;

// Height of the scene in the picture at the distance of a point.
float pictureHeightAt(vec3 position) {
    return 2.0 * (params.half_window + params.tan_half_fov * distance(position, params.eye));
}

// A cosine-weighted direction (Malley's method), and a random reach.
LightSample sampleSurroundings(vec3 position, vec3 normal, vec2 u, float u_reach) {
    float sine = sqrt(u.x), azimuth = 2.0 * kPi * u.y;
    vec3 direction = vec3(sine * cos(azimuth), sine * sin(azimuth), sqrt(1.0 - u.x));
    return LightSample(normalize(frameAround(normal) * direction), kReachShare * u_reach * pictureHeightAt(position),
                       vec3(1.0), 0.0);
}

#endif
