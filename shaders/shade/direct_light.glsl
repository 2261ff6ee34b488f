// SPDX-License-Identifier: Apache-2.0
// Which light a query asks for in each of its turns. Three programs need the same answer: it comes from the query and
// the sample's numbers alone.
#ifndef POINTRT_SHADERS_DIRECT_LIGHT_GLSL
#define POINTRT_SHADERS_DIRECT_LIGHT_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/lib/sampler.glsl"
#include "shaders/shade/sky.glsl"
#include "shaders/trace/offset.glsl"

DirectLightQuery loadLightQuery(uint path) {
    uvec4 position = loadLightQueryTexel(path, 0), normal = loadLightQueryTexel(path, 1),
          albedo = loadLightQueryTexel(path, 2), throughput = loadLightQueryTexel(path, 3),
          view = loadLightQueryTexel(path, 4);
    return DirectLightQuery(asVector(position), asFloat(position.w), asVector(normal), normal.w, asVector(albedo), albedo.w,
                            asVector(throughput), throughput.w, asVector(view), asFloat(view.w));
}

// The query of this lane; path: its pixel, NO_INDEX where it has none.
DirectLightQuery currentLightQuery(out uint path) {
    uint lane = balancedLane();
    bool live = lane < control.lists[LIST_LIT].count;
    path = live ? loadQueue(lightQueueStart() + lane) : NO_INDEX;
    return loadLightQuery(live ? path : 0u);
}

// Integrators by chance ask one light of all, the others each in turn.
const bool kAsksOne = integratorHas(kIntegrator, INTEGRATOR_BY_CHANCE);

uint lightTurns() {
    uint lights = ofLane(params.light_count);
    return kAsksOne ? min(lights, 1u) : lights;
}

float lightChance() { return kAsksOne ? 1.0 / float(params.light_count) : 1.0; }

uint lightOfTurn(uint turn, uint path, uint bounce) {
    if (!kAsksOne) return turn;
    float u = sample1(imagePixel(path), push.sample_index, dimensionPair(bounce, PAIR_LIGHT_CHOICE), params.seed);
    return min(uint(u * float(params.light_count)), params.light_count - 1u);
}

// Beyond the pairs of any bounce.
#define FIRST_LIGHT_PAIR 2048u

LightSample sampleTurn(DirectLightQuery query, uint path, uint turn, out Light light) {
    uint bounce = query.bounce;
    uint pair = dimensionPair(bounce, PAIR_LIGHT);
    // each light has its own numbers
    if (!kAsksOne) pair = FIRST_LIGHT_PAIR + bounce * MAX_LIGHTS + turn;
    light = loadLight(lightOfTurn(turn, path, bounce));
    vec2 u = sample2(imagePixel(path), push.sample_index, pair, params.seed);
    u = hasStep(STEP_PREVIEW) && lightKind(light) != LIGHT_SKY ? lightMiddle(lightKind(light)) : u;
    if (kSkyImage && lightKind(light) == LIGHT_SKY) return sampleSky(u);
    return sampleLight(light, query.position, u);
}

// The shape of a lamp with an area, NO_INDEX of other lights.
uint lampOf(Light light) {
    return hasSurface(lightKind(light)) ? floatBitsToUint(LIGHT_SHAPE(light)) : NO_INDEX;
}

bool facesLight(DirectLightQuery query, LightSample to) { return dot(query.normal, to.direction) > 0.0; }

// Shadow rays end before the lamp that they ask: a share of the way that no float's rounding exceeds.
const float kBeforeLamp = 0.99999;

// A shadow ray on its way to instances, which are asked for it.
struct TurnRay {
    vec3 origin;
    float own_t; // as of a PathState
    vec3 direction;
    float t_max; // negative: another instance has answered already
};

// The path and the turn of a list's entry.
uint turnPath(uint entry) { return entry & (1u << ASKED_TURN_SHIFT) - 1u; }
uint turnOf(uint entry) { return entry >> ASKED_TURN_SHIFT; }

TurnRay turnRay(DirectLightQuery query, uint entry) {
    uint path = turnPath(entry), turn = turnOf(entry);
    Light light;
    LightSample to = sampleTurn(query, path, turn, light);
    bool asks = (light_masks[path] >> turn & 1u) == 0u;
    float own_t;
    vec3 origin = leaveSurface(query.position, query.normal, query.radius, query.material, to.direction, own_t);
    return TurnRay(origin, own_t, to.direction, asks ? to.distance * kBeforeLamp : -1.0);
}

#endif
