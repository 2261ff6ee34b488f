// SPDX-License-Identifier: Apache-2.0
// Multiplies the light of Gaussians, at the points of LIST_DIRECT_LIGHT, by the ratio of the irradiance with the
// objects that shadow the Gaussians to the irradiance without them (Debevec, Rendering Synthetic Objects into Real
// Scenes, 1998: differential rendering). The light of lit Gaussians is their albedo, which is multiplied by the light
// that a white matte surface there reflects.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"

vec3 irradianceOf(DirectLightQuery query, LightSample to) {
    return max(dot(query.normal, to.direction), 0.0) * to.radiance_over_pdf;
}

// The irradiance by a sample of each light except the one that is tested for occlusion.
vec3 irradianceUnshadowed(DirectLightQuery query, uint path, uint tested) {
    vec3 sum = vec3(0.0);
    for (uint number = 0u; number < params.light_count; number++) {
        Light light = loadLight(number);
        uint pair = FIRST_LIGHT_PAIR + query.bounce * MAX_LIGHTS + number;
        vec2 u = sample2(imagePixel(path), push.sample_index, pair, params.seed);
        LightSample to = sampleAnyLight(light, query.position, u);
        sum += number != tested ? irradianceOf(query, to) : vec3(0.0);
    }
    return sum;
}

// The light that a white matte surface reflects from the lights that are not hidden, plus the sky's ambient light as in
// phong and whitted.
vec3 reflectedByWhite(DirectLightQuery query, uint path) {
    vec3 irradiance = vec3(0.0);
    uint samples = lightSampleCount(), mask = light_masks[path];
    for (uint number = 0u; number < samples; number++) {
        Light light;
        LightSample to = drawLightSample(query, path, number, light);
        irradiance += (mask >> number & 1u) == 0u ? irradianceOf(query, to) / lightChance() : vec3(0.0);
    }
    return irradiance / kPi + ambientLight(query.normal);
}

// The irradiance with the objects among the Gaussians, divided by the irradiance without them.
vec3 shadowRatio(DirectLightQuery query, uint path) {
    uint samples = lightSampleCount(), mask = light_masks[path];
    vec3 lit = kPi * skyColor(query.normal), hidden = vec3(0.0); // the sky as seen along the normal
    for (uint number = 0u; number < samples; number++) {
        Light light;
        LightSample to = drawLightSample(query, path, number, light);
        vec3 irradiance = irradianceOf(query, to);
        lit += irradiance;
        hidden += (mask >> number & 1u) != 0u ? irradiance / lightChance() : vec3(0.0);
    }
    if (kSamplesOneLight) lit += irradianceUnshadowed(query, path, lightOfSample(0u, path, query.bounce));
    // if only one of many lights is sampled, hidden may exceed lit in a single sample: only their means are right
    return 1.0 - hidden / max(lit, vec3(1e-20));
}

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    if (path == NO_INDEX) return;
    gaussian_light[path].light.rgb *= kRelights ? reflectedByWhite(query, path) : shadowRatio(query, path);
}
