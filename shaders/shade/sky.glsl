// SPDX-License-Identifier: Apache-2.0
// Light from all around.
#ifndef POINTRT_SHADERS_SKY_GLSL
#define POINTRT_SHADERS_SKY_GLSL
#include "shaders/shade/lights.glsl"
#include "shaders/shade/environment.glsl"

// Whether the sky is an image in place of a gradient.
layout(constant_id = SPEC_SKY_IMAGE) const bool kSkyImage = false;

// What a ray that leaves the scene sees: an image, or a gradient by the square root of the height over the horizon.
vec3 skyColor(vec3 direction) {
    if (kSkyImage) return environmentRadiance(params.environment, direction);
    float height = dot(direction, params.sky_up);
    return mix(params.sky_horizon, height > 0.0 ? params.sky_zenith : params.sky_ground, sqrt(abs(height)));
}

// The sky's share that phong and whitted take as light from everywhere, standing in for what bounces around a scene.
vec3 ambientLight(vec3 normal) { return skyColor(normal) * params.ambient_share; }

// Suns are seen in mirrors and through glass; matte surfaces have asked for them.
vec3 sunsSeen(vec3 direction) {
    vec3 seen = vec3(0.0);
    if (!mayHaveLight(LIGHT_SUN)) return seen;
    uint lights = ofLane(params.light_count);
    for (uint l = 0u; l < lights; l++) {
        Light light = loadLight(l);
        bool meets = lightKind(light) == LIGHT_SUN && meetsSun(light, direction);
        seen += meets ? lightRadiance(light) : vec3(0.0);
    }
    return seen;
}

LightSample sampleSky(vec2 u) {
    vec3 direction;
    float pdf;
    vec3 radiance = sampleEnvironment(params.environment, u, direction, pdf);
    return LightSample(direction, kLightAfar, pdf > 0.0 ? radiance / pdf : vec3(0.0), pdf);
}

// What a path sees that has left the scene; an image's light was asked for beside the scattered ray.
vec3 skySeen(PathState path) {
    vec3 direction = path.direction;
    float scatter_pdf = path.pdf, share = 1.0;
    bool sees_suns = scatter_pdf == 0.0 && (path.bits & PATH_CAUSTIC) == 0u;
    if (sees_suns) return skyColor(direction) + sunsSeen(direction);
    if (scatter_pdf == 0.0) return skyColor(direction);
    if (kSkyImage) {
        float light_pdf = environmentPdf(params.environment, direction) / float(params.light_count);
        share = scatter_pdf / (scatter_pdf + light_pdf);
    }
    return skyColor(direction) * share;
}

#endif
