// SPDX-License-Identifier: Apache-2.0
// The fused form's paths, in registers from hit to hit, and the light that they ask for on their way.
#ifndef POINTRT_SHADERS_JOURNEY_GLSL
#define POINTRT_SHADERS_JOURNEY_GLSL
#include "shaders/shade/shade_hit.glsl"
#include "shaders/shade/film.glsl"
#include "shaders/shade/scattered_light.glsl"
#include "shaders/shade/shape_shadow.glsl"
#include "shaders/trace/shape_hit.glsl"
#include "shaders/trace/reach.glsl"

// A path on its way. Lanes that have none go along with nothing to do, and so do those whose path has ended or waits:
// what is computed for them is not kept.
struct Journey {
    PathState path;
    uvec4 hit;      // of its ray
    PixelSums sums; // the pixel's in the film
    bool going;     // it stays in registers
    bool onward;    // or goes on in the next pass,
    bool asks;      // after instances were asked for its ray,
    uint waits;     // or for its shadow rays: a bit for each light's turn
    ShadowRay shadow;       // of the one light that integrators by chance ask
    DirectLightQuery query; // the point that others ask all lights from
    uint rays, shadow_rays; // taken in registers, asked for
};

const ShadowRay kNoShadow = ShadowRay(vec3(0.0), 0.0, vec3(0.0), -1.0, vec3(0.0), 0u, vec3(0.0), 0u);
const DirectLightQuery kNoQuery = DirectLightQuery(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0.0);

// A light that is asked for, and the way to it.
struct LightRay {
    uint turn;
    Light light;
    LightSample to;
    vec3 origin;
    float own_t;
    float t_min; // where it leaves a shape
};

LightRay lightRay(DirectLightQuery query, uint index, uint turn) {
    LightRay ray;
    ray.turn = turn;
    ray.to = sampleTurn(query, index, turn, ray.light);
    ray.origin = leaveSurface(query.position, query.normal, query.radius, query.material, ray.to.direction, ray.own_t);
    ray.t_min = nearestFrom(query.owner, ray.origin);
    return ray;
}

// What comes by the ray: at once, or unless an instance is in its way.
struct LightAnswer {
    vec3 brought;
    bool asks, waits; // for shadows
};

// hit: of the shapes.
LightAnswer answerOf(bool wants, DirectLightQuery query, Bsdf bsdf, LightRay ray, ShapeHit hit) {
    // while things move, the key light's shadows alone: they say where things stand
    bool shadows = hasOption(OPTION_SHADOWS) && (!hasStep(STEP_PREVIEW) || ray.turn == 0u);
    bool faces = wants && facesLight(query, ray.to), dark = !faces || (shadows && hides(hit, ray.to, ray.light));
    vec3 scattered = scatteredLight(bsdf, query.normal, query.view, ray.to, lightKind(ray.light), lightChance());
    vec3 brought = dark ? vec3(0.0) : query.throughput * (scattered * ray.to.radiance_over_pdf);
    bool meets = meetsInstances(ray.origin, ray.to.direction, ray.to.distance * kBeforeLamp);
    return LightAnswer(brought, faces && shadows, shadows && largest(brought) > 0.0 && meets);
}

// One light's, in turn with the shapes on the path's next ray: each is loaded once for both.
void askOne(inout Journey journey, bool wants, DirectLightQuery query, Bsdf bsdf, uint index, PathState after,
            float after_min, out ShapeHit next) {
    LightRay ray = lightRay(query, index, 0u);
    ShapeHit between;
    nearestShapes(ofLane(params.shape_count), ray.origin, ray.to.direction, ray.t_min, after.origin, after.direction,
                  after_min, between, next);
    LightAnswer answer = answerOf(wants, query, bsdf, ray, between);
    journey.shadow_rays += answer.asks ? 1u : 0u;
    if (answer.waits)
        journey.shadow = ShadowRay(ray.origin, ray.own_t, ray.to.direction, ray.to.distance * kBeforeLamp,
                                   query.normal * query.side, query.owner, answer.brought, query.bounce + 1u);
    else
        addLight(journey.sums, answer.brought, query.bounce + 1u);
    journey.waits |= answer.waits ? 1u : 0u;
}

// All lights' in turn; those that wait are asked again by programs that walk, and by light. Or all of it is left to the
// queued form's programs.
void askAll(inout Journey journey, bool wants, DirectLightQuery query, Bsdf bsdf, uint index) {
    if (wants) journey.query = query;
    uint turns = kLightOnTheWay ? lightTurns() : 0u, waits = !kLightOnTheWay && wants ? 1u : 0u;
    vec3 sum = vec3(0.0);
    for (uint turn = 0u; turn < turns; turn++) {
        LightRay ray = lightRay(query, index, turn);
        ShapeHit between = nearestShape(ofLane(params.shape_count), ray.origin, ray.to.direction, ray.t_min);
        LightAnswer answer = answerOf(wants, query, bsdf, ray, between);
        journey.shadow_rays += answer.asks ? 1u : 0u;
        waits |= answer.waits ? 1u << turn : 0u;
        sum += answer.waits ? vec3(0.0) : answer.brought;
    }
    if (kLightOnTheWay) addLight(journey.sums, sum, query.bounce + 1u);
    journey.waits |= waits;
}

#endif
