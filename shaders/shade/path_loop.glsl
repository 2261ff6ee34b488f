// SPDX-License-Identifier: Apache-2.0
// The megakernel's path state in registers from hit to hit, and its next event estimation.
#ifndef POINTRT_SHADERS_PATH_LOOP_GLSL
#define POINTRT_SHADERS_PATH_LOOP_GLSL
#include "shaders/shade/shade_hit.glsl"
#include "shaders/shade/film.glsl"
#include "shaders/shade/scattered_light.glsl"
#include "shaders/shade/shape_shadow.glsl"
#include "shaders/trace/shape_hit.glsl"

// State of a lane in the path loop. Idle lanes, and lanes whose path has ended or waits for instances, take part in the
// loop without effect.
struct PathLoop {
    PathState path;
    uvec4 hit;              // of the path's ray
    PixelSums sums;         // of the pixel in the film
    bool running;           // the path continues in this loop
    bool queued;            // the path continues in the next pass
    bool ray_waits;         // the queued path's ray must first be intersected with instances
    uint shadows_wait;      // and so must its shadow rays: a bit for each light sample
    ShadowRay shadow;       // with one light sample: the shadow ray that waits
    DirectLightQuery query; // with all lights: the point whose shadow rays wait
    uint rays, shadow_rays; // traced in this loop
};

const ShadowRay kNoShadow = ShadowRay(vec3(0.0), 0.0, vec3(0.0), -1.0, vec3(0.0), 0u, vec3(0.0), 0u);
const DirectLightQuery kNoQuery =
    DirectLightQuery(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0.0);

// The result of a light sample once shapes have been tested.
struct DirectLight {
    vec3 light;  // contribution to the pixel
    bool traced; // its shadow ray was traced
    bool waits;  // instances may still occlude it
};

// hit: nearest shape on the shadow ray.
DirectLight evaluateLightRay(bool live, DirectLightQuery query, Bsdf bsdf, LightRay ray, ShapeHit hit) {
    bool shadows = castsShadow(ray);
    bool faces = live && facesLight(query, ray.to), dark = !faces || (shadows && occludes(hit, ray));
    vec3 scattered = scatteredLight(bsdf, query.normal, query.view, ray.to, lightKind(ray.light), lightChance());
    vec3 light = dark ? vec3(0.0) : query.throughput * (scattered * ray.to.radiance_over_pdf);
    bool may_hit = mayHitInstances(ray);
    return DirectLight(light, faces && shadows, shadows && largest(light) > 0.0 && may_hit);
}

// Samples one light, and intersects its shadow ray and the path's next ray with the shapes: each shape is loaded once
// for both.
void sampleOneLight(inout PathLoop loop, bool live, DirectLightQuery query, Bsdf bsdf, uint index, PathState next_path,
                    float next_min, out ShapeHit next_hit) {
    LightRay ray = lightRay(query, index, 0u);
    ShapeHit between;
    nearestShapes(ofLane(params.shape_count), ray.origin, ray.to.direction, shapeMinDistance(query.owner, ray.origin),
                  next_path.origin, next_path.direction, next_min, between, next_hit);
    DirectLight direct = evaluateLightRay(live, query, bsdf, ray, between);
    loop.shadow_rays += direct.traced ? 1u : 0u;
    if (direct.waits)
        loop.shadow = shadowRay(query, ray, direct.light);
    else
        accumulateLight(loop.sums, direct.light, query.bounce + 1u);
    loop.shadows_wait |= direct.waits ? 1u : 0u;
}

// Samples every light. Samples that wait for instances go through intersect_shadow and shade_shadow. Without kInlineNee
// the whole query is left to the wavefront programs.
void sampleAllLights(inout PathLoop loop, bool live, DirectLightQuery query, Bsdf bsdf, uint index) {
    if (live) loop.query = query;
    uint samples = kInlineNee ? lightSampleCount() : 0u, waits = !kInlineNee && live ? 1u : 0u;
    vec3 sum = vec3(0.0);
    for (uint number = 0u; number < samples; number++) {
        LightRay ray = lightRay(query, index, number);
        ShapeHit between = nearestShape(ofLane(params.shape_count), ray.origin, ray.to.direction,
                                        shapeMinDistance(query.owner, ray.origin));
        DirectLight direct = evaluateLightRay(live, query, bsdf, ray, between);
        loop.shadow_rays += direct.traced ? 1u : 0u;
        waits |= direct.waits ? 1u << number : 0u;
        sum += direct.waits ? vec3(0.0) : direct.light;
    }
    if (kInlineNee) accumulateLight(loop.sums, sum, query.bounce + 1u);
    loop.shadows_wait |= waits;
}

#endif
