// SPDX-License-Identifier: Apache-2.0
// Accumulates direct light: the unoccluded light samples of the points of LIST_DIRECT_LIGHT.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/scattered_light.glsl"
#include "shaders/shade/film.glsl"

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    if (path == NO_INDEX) return;
    uint samples = lightSampleCount(), mask = light_masks[path];
    vec3 normal = query.normal, view = query.view;
    Bsdf bsdf = makeBsdf(loadMaterial(query.material & SURFACE_MATERIAL_MASK), query.albedo, false, dot(normal, view));
    float chance = lightChance();
    vec3 light_sum = vec3(0.0);
    for (uint number = 0u; number < samples; number++) {
        Light light;
        LightSample to = drawLightSample(query, path, number, light);
        vec3 scattered = scatteredLight(bsdf, normal, view, to, lightKind(light), chance);
        light_sum += (mask >> number & 1u) == 0u ? scattered * to.radiance_over_pdf : vec3(0.0);
    }
    accumulateLight(path, query.throughput * light_sum, query.bounce + 1u);
}
