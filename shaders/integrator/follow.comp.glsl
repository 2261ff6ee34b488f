// SPDX-License-Identifier: Apache-2.0
// The fused form: what shade, shadow_shapes, light and trace_shapes do in turn, over and over while the path stays in
// registers. It leaves them where its next ray may meet an instance, or a shadow ray of its own may: those go by lists to
// programs that walk. For integrators by chance, whose points ask one light.
//
// Whatever lanes a path shares its subgroup with, its light is added up in the same order: pictures are the same to the
// bit each time.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "shaders/integrator/shade_hit.glsl"
#include "shaders/film/film.glsl"
#include "shaders/frame/append.glsl"
#include "shaders/light/caustic_light.glsl"
#include "shaders/light/scattered_light.glsl"
#include "shaders/light/shape_shadow.glsl"
#include "shaders/trace/shape_hit.glsl"
#include "shaders/trace/reach.glsl"

// A path on its way. Lanes that have none go along with nothing to do, and so do those whose path has ended or waits:
// what is computed for them is not kept.
struct Journey {
    PathState path;
    uvec4 hit;         // of its ray
    PixelSums sums;    // the pixel's in the film
    bool going;        // it stays in registers
    bool onward;       // or goes on in the next pass,
    bool asks;         // after instances were asked for its ray,
    bool waits;        // or for its shadow ray
    ShadowRay shadow;
    uint rays, shadow_rays; // taken in registers, asked for
};

const ShadowRay kNoShadow = ShadowRay(vec3(0.0), 0.0, vec3(0.0), -1.0, vec3(0.0), 0u, vec3(0.0), 0u);

// A light that is asked for, and the way to it.
struct LightRay {
    Light light;
    LightSample to;
    vec3 origin;
    float own_t;
    float t_min; // where it leaves a shape
};

LightRay lightRay(DirectLightQuery query, uint index) {
    LightRay ray;
    ray.to = sampleTurn(query, index, 0u, ray.light);
    ray.origin = leaveSurface(query.position, query.normal, query.radius, query.material, ray.to.direction, ray.own_t);
    ray.t_min = nearestFrom(query.owner, ray.origin);
    return ray;
}

// The light that comes by the ray, or a shadow ray that brings it unless an instance is in its way. hit: of the shapes.
void askLight(inout Journey journey, bool wants, DirectLightQuery query, Bsdf bsdf, LightRay ray, ShapeHit hit) {
    bool shadows = hasOption(OPTION_SHADOWS), faces = wants && facesLight(query, ray.to);
    bool dark = !faces || (shadows && hides(hit, ray.to, ray.light));
    vec3 scattered = scatteredLight(bsdf, query.normal, query.view, ray.to, lightKind(ray.light), lightChance());
    vec3 brought = dark ? vec3(0.0) : query.throughput * (scattered * ray.to.radiance_over_pdf);
    float t_max = ray.to.distance * kBeforeLamp;
    bool waits = shadows && largest(brought) > 0.0 && meetsInstances(ray.origin, ray.to.direction, t_max);
    journey.shadow_rays += faces && shadows ? 1u : 0u;
    if (waits)
        journey.shadow = ShadowRay(ray.origin, ray.own_t, ray.to.direction, t_max, query.normal * query.side, query.owner,
                                   brought, query.bounce + 1u);
    else
        addLight(journey.sums, brought, query.bounce + 1u);
    journey.waits = journey.waits || waits;
}

// To its next hit, unless an instance may be nearer.
void takeNext(inout Journey journey, bool goes_on, PathState after, ShapeHit hit) {
    bool asks = goes_on && meetsInstances(after.origin, after.direction, hit.t);
    if (goes_on) {
        journey.path = after;
        journey.hit = hitWords(hit);
    }
    journey.going = goes_on && !asks && !journey.waits;
    journey.onward = journey.onward || (goes_on && !journey.going);
    journey.asks = journey.asks || asks;
    journey.rays += journey.going ? 1u : 0u;
}

// What splats it met are known of the first hit alone: others would have to be asked for.
SurfaceInteraction pointOf(Journey journey, SurfaceInteraction splats) {
    if (journey.hit.z == NO_INDEX) return noInteraction();
    if (journey.hit.w == OWNER_SHAPES) return shapeInteraction(journey.path, journey.hit);
    return splats;
}

void bounceOn(inout Journey journey, SurfaceInteraction point, uint index) {
    settleSides(point, journey.path);
    bool back = isBack(point);
    uint bounce = bounceOf(journey.path.bits);
    vec3 view = -journey.path.direction;
    Material row = loadMaterial(materialOf(point));
    Bsdf bsdf = makeBsdf(row, point.albedo, back, dot(point.normal, view));
    PathState path = journey.path;
    path.throughput *= back ? transmittance(row, point.t) : vec3(1.0);
    Shading shading = shadeHit(path, point, row, bsdf, imagePixel(index));
    if (journey.going) addLight(journey.sums, shading.added, bounce);
    DirectLightQuery query = lightQuery(point, view, shading.direct_weight, bounce);
    LightRay ray = lightRay(query, index);
    PathState after = pathAfter(point, journey.path, shading.first, 0u);
    ShapeHit between, next;
    nearestShapes(ofLane(params.shape_count), ray.origin, ray.to.direction, ray.t_min, after.origin, after.direction,
                  nearestFrom(point.owner, after.origin), between, next);
    bool asks = journey.going && asksForLight(shading);
    // smooth lobes are the same from both sides
    askLight(journey, asks, query, bsdf, ray, between);
    if (kGathersPhotons) addCaustic(journey.sums, causticLight(asks && params.caustics.count.x > 0u, query, row, bsdf));
    takeNext(journey, mayGoOn() && journey.going && largest(shading.first.weight) > 0.0, after, next);
}

// Worth another turn: no more than one lane in eight would stand by and wait for instances.
bool goesOn(Journey journey) {
    uint waiting = subgroupBallotBitCount(subgroupBallot(journey.onward));
    return subgroupAny(journey.going) && waiting * 8u <= gl_SubgroupSize;
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes work along: the appends below need the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction splats = splatInteraction(index);
    Journey journey = Journey(path, hit, loadSums(index), live, false, false, false, kNoShadow, 0u, 0u);
    if (kCameraPass) {
        SurfaceInteraction point = pointOf(journey, splats);
        bool first = push.sample_index == 0u;
        float covered = covers(point) ? 1.0 : 0.0;
        journey.sums = beginSums(journey.sums, first, covered);
        if (live) addAlbedo(index, first, covered, covered * point.albedo);
    }
    do {
        bounceOn(journey, pointOf(journey, splats), index);
    } while (goesOn(journey));

    if (live) storeSums(index, journey.sums);
    bool onward = journey.onward || journey.going;
    if (onward) imageStore(hit_texels, int(index), journey.hit);
    appendRay(onward, index, journey.path);
    appendEntry(APPEND_ASKED, journey.asks, index);
    appendEntry(APPEND_LIGHT_QUERY, journey.waits, index);
    if (journey.waits) shadow_rays[index] = journey.shadow;
    journey.rays -= journey.going ? 1u : 0u; // it is among those of the queue
    uint rays = subgroupAdd(journey.rays), shadows = subgroupAdd(journey.shadow_rays);
    // those that go on by the queue are counted there
    if (subgroupElect() && rays > 0u) atomicAdd(control.secondary_rays, rays);
    if (subgroupElect() && shadows > 0u) atomicAdd(control.shadow_rays, shadows);
}
