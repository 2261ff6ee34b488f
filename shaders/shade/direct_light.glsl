// SPDX-License-Identifier: Apache-2.0
// Next event estimation: light samples and shadow rays of a direct-lighting query. Several programs need the same
// samples, so these depend only on the query and the sample's random numbers.
#ifndef POINTRT_SHADERS_DIRECT_LIGHT_GLSL
#define POINTRT_SHADERS_DIRECT_LIGHT_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/lib/sampler.glsl"
#include "shaders/shade/ambient.glsl"
#include "shaders/trace/instance_bounds.glsl"
#include "shaders/trace/offset.glsl"

DirectLightQuery loadLightQuery(uint path) {
    uvec4 position = loadLightQueryTexel(path, 0), normal = loadLightQueryTexel(path, 1),
          albedo = loadLightQueryTexel(path, 2), throughput = loadLightQueryTexel(path, 3),
          view = loadLightQueryTexel(path, 4);
    return DirectLightQuery(asVector(position), asFloat(position.w), asVector(normal), normal.w, asVector(albedo), albedo.w,
                            asVector(throughput), throughput.w, asVector(view), asFloat(view.w));
}

// The query of this lane; path: NO_INDEX if it has none.
DirectLightQuery currentLightQuery(out uint path) {
    uint lane = balancedLane();
    bool live = lane < control.lists[LIST_DIRECT_LIGHT].count;
    path = live ? loadQueue(lightQueueStart() + lane) : NO_INDEX;
    return loadLightQuery(live ? path : 0u);
}

// Stochastic integrators sample one light chosen at random, the others every light.
const bool kSamplesOneLight = integratorHas(kIntegrator, INTEGRATOR_IS_STOCHASTIC);

uint lightSampleCount() {
    uint lights = ofLane(params.light_count);
    return kSamplesOneLight ? min(lights, 1u) : lights;
}

// Probability of choosing a light.
float lightChance() { return kSamplesOneLight ? 1.0 / float(params.light_count) : 1.0; }

// The light of a light sample. number: of the sample, below lightSampleCount().
uint lightOfSample(uint number, uint path, uint bounce) {
    if (!kSamplesOneLight) return number;
    float u = sample1(imagePixel(path), push.sample_index, dimensionPair(bounce, PAIR_LIGHT_CHOICE), params.seed);
    return min(uint(u * float(params.light_count)), params.light_count - 1u);
}

// The first sample pair beyond those that bounces use.
#define FIRST_LIGHT_PAIR 2048u

LightSample sampleAnyLight(Light light, vec3 position, vec2 u) {
    if (kSkyImage && lightKind(light) == LIGHT_SKY) return sampleSky(u);
    return sampleLight(light, position, u);
}

LightSample drawLightSample(DirectLightQuery query, uint path, uint number, out Light light) {
    uint bounce = query.bounce;
    uint pair = dimensionPair(bounce, PAIR_LIGHT);
    // each light has its own random numbers
    if (!kSamplesOneLight) pair = FIRST_LIGHT_PAIR + bounce * MAX_LIGHTS + number;
    light = loadLight(lightOfSample(number, path, bounce));
    vec2 u = sample2(imagePixel(path), push.sample_index, pair, params.seed);
    if (kIsAmbient) {
        float u_reach = sample1(imagePixel(path), push.sample_index, dimensionPair(bounce, PAIR_CHOICES), params.seed);
        return sampleSurroundings(query.position, query.normal, u, u_reach);
    }
    u = hasStep(STEP_PREVIEW) && lightKind(light) != LIGHT_SKY ? lightMiddle(lightKind(light)) : u;
    return sampleAnyLight(light, query.position, u);
}

// The shape of an area light, NO_INDEX for other lights.
uint shapeOfLight(Light light) {
    return hasSurface(lightKind(light)) ? floatBitsToUint(LIGHT_SHAPE(light)) : NO_INDEX;
}

bool facesLight(DirectLightQuery query, LightSample to) { return dot(query.normal, to.direction) > 0.0; }

// Shadow rays end just before their light, at this share of the distance: farther from 1 than the rounding of floats.
const float kBeforeLight = 0.99999;

// A light sample and the start of its shadow ray.
struct LightRay {
    uint number; // of the light sample
    Light light;
    LightSample to;
    vec3 origin;
    float self_t; // self-intersection distance
};

LightRay lightRay(DirectLightQuery query, uint path, uint number) {
    LightRay ray;
    ray.number = number;
    ray.to = drawLightSample(query, path, number, ray.light);
    ray.origin =
        offsetRayOrigin(query.position, query.normal, query.radius, query.material, ray.to.direction, ray.self_t);
    return ray;
}

// Whether a light sample is tested for occlusion. Previews show only the shadows of the key light, as cues of position.
bool castsShadow(LightRay ray) {
    return hasOption(OPTION_SHADOWS) && (!hasStep(STEP_PREVIEW) || ray.number == 0u);
}

bool mayHitInstances(LightRay ray) {
    return mayHitInstances(ray.origin, ray.to.direction, ray.to.distance * kBeforeLight);
}

// light: its contribution to the pixel if nothing occludes the ray.
ShadowRay shadowRay(DirectLightQuery query, LightRay ray, vec3 light) {
    return ShadowRay(ray.origin, ray.self_t, ray.to.direction, ray.to.distance * kBeforeLight,
                     query.normal * query.side, query.owner, light, query.bounce + 1u);
}

// Path and number of the light sample of an entry of LIST_SHADOW_RAYS.
uint pathOfEntry(uint entry) { return entry & (1u << SHADOW_RAY_LIGHT_SHIFT) - 1u; }
uint lightSampleOfEntry(uint entry) { return entry >> SHADOW_RAY_LIGHT_SHIFT; }

// The shadow ray of an entry, drawn again from its query. Its t_max is negative if another instance occludes it.
ShadowRay shadowRayOfEntry(uint entry) {
    uint path = pathOfEntry(entry), number = lightSampleOfEntry(entry);
    DirectLightQuery query = loadLightQuery(path);
    ShadowRay ray = shadowRay(query, lightRay(query, path, number), vec3(0.0));
    ray.t_max = (light_masks[path] >> number & 1u) == 0u ? ray.t_max : -1.0;
    return ray;
}

#endif
