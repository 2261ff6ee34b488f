// SPDX-License-Identifier: Apache-2.0
// The sky: gradient or environment image, ambient light, visible suns.
#ifndef POINTRT_SHADERS_SKY_GLSL
#define POINTRT_SHADERS_SKY_GLSL
#include "shaders/shade/lights.glsl"
#include "shaders/shade/environment.glsl"

// Whether the sky is an environment image instead of a gradient.
layout(constant_id = SPEC_SKY_IMAGE) const bool kSkyImage = false;

// Radiance of an escaped ray: the image, or a gradient by the square root of the height above the horizon.
vec3 skyColor(vec3 direction) {
    if (kSkyImage) return environmentRadiance(params.environment, direction);
    float height = dot(direction, params.sky_up);
    return mix(params.sky_horizon, height > 0.0 ? params.sky_zenith : params.sky_ground, sqrt(abs(height)));
}

// Unshadowed ambient light of phong and whitted: a share of the sky's light, in place of interreflection.
vec3 ambientLight(vec3 normal) { return skyColor(normal) * params.ambient_share; }

// Radiance of suns in this direction, for escaped rays of mirrors and glass; other surfaces sample suns as lights.
vec3 sunsSeen(vec3 direction) {
    vec3 seen = vec3(0.0);
    if (!mayHaveLight(LIGHT_SUN)) return seen;
    uint lights = ofLane(params.light_count);
    for (uint l = 0u; l < lights; l++) {
        Light light = loadLight(l);
        bool hit = lightKind(light) == LIGHT_SUN && hitsSun(light, direction);
        seen += hit ? lightRadiance(light) : vec3(0.0);
    }
    return seen;
}

LightSample sampleSky(vec2 u) {
    vec3 direction;
    float pdf;
    vec3 radiance = sampleEnvironment(params.environment, u, direction, pdf);
    return LightSample(direction, kLightAfar, pdf > 0.0 ? radiance / pdf : vec3(0.0), pdf);
}

// Radiance of an escaped path, with the MIS weight of a BSDF sample against light samples of the sky image.
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
