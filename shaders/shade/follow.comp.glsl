// SPDX-License-Identifier: Apache-2.0
// The fused form: what shade, shadow_shapes, light and trace_shapes do in turn, over and over while the path stays in
// registers. It leaves them where its next ray may meet an instance, or a shadow ray of its own may: those go by lists to
// programs that walk. So do, where paths go on and ask all lights, the points that ask.
//
// Whatever lanes a path shares its subgroup with, its light is added up in the same order: pictures are the same to the
// bit each time.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "shaders/shade/go_on.glsl"
#include "shaders/shade/journey.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/shade/caustic_light.glsl"

// To its next hit, unless an instance may be nearer.
void takeNext(inout Journey journey, bool goes_on, PathState after, ShapeHit hit) {
    bool asks = goes_on && meetsInstances(after.origin, after.direction, hit.t);
    if (goes_on) {
        journey.path = after;
        journey.hit = hitWords(hit);
    }
    journey.going = goes_on && !asks && journey.waits == 0u;
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

void bounceOn(inout Journey journey, SurfaceInteraction met, uint index) {
    uint bounce = bounceOf(journey.path.bits);
    vec3 view = -journey.path.direction;
    ShadedHit shaded = shadeAt(journey.path, met, index);
    if (journey.going) addLight(journey.sums, shaded.shading.added, bounce);
    DirectLightQuery query = lightQuery(shaded.point, view, shaded.shading.direct_weight, bounce);
    bool asks = journey.going && asksForLight(shaded.shading);
    PathState after;
    bool goes_on = nextPath(journey.path, shaded.point, shaded.shading, index, mayGoOn() && journey.going, after);
    float after_min = nearestFrom(after.bits >> PATH_OWNER_SHIFT, after.origin);
    ShapeHit next;
    if (kAsksOne) {
        askOne(journey, asks, query, shaded.bsdf, index, after, after_min, next);
    } else {
        next = nearestShape(mayGoOn() ? ofLane(params.shape_count) : 0u, after.origin, after.direction, after_min);
        askAll(journey, asks, query, shaded.bsdf, index);
    }
    if (kGathersPhotons && kLightOnTheWay)
        addCaustic(journey.sums, causticLight(asks && params.caustics.count.x > 0u, query, shaded.row, shaded.bsdf));
    takeNext(journey, goes_on, after, next);
}

// lavapipe ends all loops of a program without a word when they have taken 65,535 turns together. Half of it is for those
// that can be told before; a gathering point takes a turn for each photon, a thousand or two where they are dense.
const uint kMostTurns = 32768u, kMostGathers = 16u;

// Those of a bounce: shapes for the next ray, and in turn with that for the one light that may be asked here.
uint turnsOfBounce() { return ofLane(params.shape_count) + 1u; }

// Worth another turn after so many bounces: no more than one lane in eight would stand by and wait for instances.
bool goesOn(Journey journey, uint bounces) {
    uint waiting = subgroupBallotBitCount(subgroupBallot(journey.onward));
    bool may = bounces * turnsOfBounce() < kMostTurns && (!kGathersPhotons || bounces < kMostGathers);
    return subgroupAny(journey.going && may) && waiting * 8u <= gl_SubgroupSize;
}

// The shadow rays that wait.
void listShadows(Journey journey, uint index) {
    bool waits = journey.waits != 0u;
    appendEntry(LIST_LIT, waits, index);
    if (kAsksOne) {
        if (waits) shadow_rays[index] = journey.shadow;
    } else {
        if (waits) light_queries[index] = journey.query;
        if (waits && kLightOnTheWay) light_masks[index] = ~journey.waits; // the other lights' has been added
        uint turns = kLightOnTheWay ? lightTurns() : 0u;
        for (uint turn = 0u; turn < turns; turn++)
            appendEntry(LIST_TURNS, (journey.waits >> turn & 1u) != 0u, index | turn << ASKED_TURN_SHIFT);
    }
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes work along: the appends below need the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    SurfaceInteraction splats = splatInteraction(index);
    Journey journey = Journey(path, hit, loadSums(index), live, false, false, 0u, kNoShadow, kNoQuery, 0u, 0u);
    if (kCameraPass) {
        SurfaceInteraction point = pointOf(journey, splats);
        bool first = push.sample_index == 0u;
        float covered = covers(point) ? 1.0 : 0.0;
        journey.sums = beginSums(journey.sums, first, covered);
        if (live) addAlbedo(index, first, covered, covered * point.albedo);
    }
    uint bounces = 0u;
    do {
        bounceOn(journey, pointOf(journey, splats), index);
        bounces++;
    } while (goesOn(journey, bounces));

    if (live) storeSums(index, journey.sums);
    bool onward = journey.onward || journey.going;
    if (onward) imageStore(hit_texels, int(index), journey.hit);
    appendRay(onward, index, journey.path);
    appendEntry(LIST_ASKED, journey.asks, index);
    listShadows(journey, index);
    journey.rays -= journey.going ? 1u : 0u; // it is among those of the queue
    uint rays = subgroupAdd(journey.rays), shadows = subgroupAdd(journey.shadow_rays);
    // those that go on by the queue are counted there
    if (subgroupElect() && rays > 0u) atomicAdd(control.secondary_rays, rays);
    if (subgroupElect() && shadows > 0u) atomicAdd(control.shadow_rays, shadows);
}
