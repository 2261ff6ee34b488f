// SPDX-License-Identifier: Apache-2.0
// The megakernel: shade_surface, intersect_shadow_shapes, shade_shadow and intersect_shapes in a loop, with the path
// state in registers. A path leaves the loop when instances may occlude its shadow ray or be hit by its next ray; such
// rays are queued for the programs that traverse instances. If paths continue and the integrator samples every light,
// the points that need direct light are queued too. With kOneBounce every path leaves the loop after its first bounce.
//
// A path's light is accumulated in the same order whichever lanes share its subgroup, so pictures are reproducible to
// the bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "shaders/shade/continue_path.glsl"
#include "shaders/shade/path_loop.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/shade/caustic_light.glsl"
#include "shaders/shade/gaussian_light.glsl"

// Advances to the next hit, unless an instance may be nearer.
void advance(inout PathLoop loop, bool continues, PathState next_path, ShapeHit hit) {
    bool waits = continues && mayHitInstances(next_path.origin, next_path.direction, hit.t);
    if (continues) {
        loop.path = next_path;
        loop.hit = hitWords(hit);
    }
    loop.running = continues && !waits && loop.shadows_wait == 0u;
    loop.queued = loop.queued || (continues && !loop.running);
    loop.ray_waits = loop.ray_waits || waits;
    loop.rays += loop.running ? 1u : 0u;
}

// The interaction at the loop's current hit. Only the first hit of the loop may be on splats: if a later ray may hit an
// instance, the path leaves the loop.
SurfaceInteraction interactionOf(PathLoop loop, SurfaceInteraction splats) {
    if (loop.hit.z == NO_INDEX) return noInteraction();
    if (loop.hit.w == OWNER_SHAPES) return shapeInteraction(loop.path, loop.hit);
    return splats;
}

// One bounce: shading, next event estimation and the next ray.
void shadeBounce(inout PathLoop loop, SurfaceInteraction hit, uint index) {
    uint bounce = bounceOf(loop.path.bits);
    vec3 view = -loop.path.direction;
    ShadedHit shaded = shadeAt(loop.path, hit, index);
    if (loop.running) accumulateLight(loop.sums, shaded.shading.radiance, bounce);
    DirectLightQuery query = lightQuery(shaded.point, view, shaded.shading.direct_weight, bounce);
    bool lit = loop.running && needsDirectLight(shaded.shading);
    PathState next_path;
    bool may_continue = mayHaveSecondaryRays() && loop.running;
    bool continues = continuePath(loop.path, shaded.point, shaded.shading, index, may_continue, next_path);
    float next_min = shapeMinDistance(next_path.bits >> PATH_OWNER_SHIFT, next_path.origin);
    ShapeHit next_hit;
    if (kSamplesOneLight) {
        sampleOneLight(loop, lit, query, shaded.bsdf, index, next_path, next_min, next_hit);
    } else {
        next_hit = nearestShape(mayHaveSecondaryRays() ? ofLane(params.shape_count) : 0u, next_path.origin,
                                next_path.direction, next_min);
        sampleAllLights(loop, lit, query, shaded.bsdf, index);
    }
    if (kGathersPhotons && kInlineNee)
        accumulateCaustic(loop.sums, causticLight(lit && params.caustics.count.x > 0u, query, shaded.row, shaded.bsdf));
    advance(loop, continues, next_path, next_hit);
}

// lavapipe silently ends all loops of a program once they have run 65,535 iterations together. Half of that is left for
// loops of unknown length: gathering photons takes an iteration per photon, one or two thousand where they are dense.
const uint kMostIterations = 32768u, kMostGathers = 16u;

// Loop iterations per bounce: one for each shape, which serves the next ray and the shadow ray, and one for the bounce.
uint iterationsPerBounce() { return ofLane(params.shape_count) + 1u; }

// Whether another iteration is worthwhile: true if at most one lane in eight waits for instances.
bool continuesLoop(PathLoop loop, uint bounces) {
    uint waiting = subgroupBallotBitCount(subgroupBallot(loop.queued));
    bool may = bounces * iterationsPerBounce() < kMostIterations && (!kGathersPhotons || bounces < kMostGathers);
    return subgroupAny(loop.running && may) && waiting * 8u <= gl_SubgroupSize;
}

// Queues the shadow rays that instances may occlude.
void queueShadowRays(PathLoop loop, uint index) {
    bool waits = loop.shadows_wait != 0u;
    appendEntry(LIST_DIRECT_LIGHT, waits, index);
    if (kSamplesOneLight) {
        if (waits) shadow_rays[index] = loop.shadow;
    } else {
        if (waits) light_queries[index] = loop.query;
        // the other samples have been accumulated already
        if (waits && kInlineNee) light_masks[index] = ~loop.shadows_wait;
        uint samples = kInlineNee ? lightSampleCount() : 0u;
        for (uint number = 0u; number < samples; number++)
            appendEntry(LIST_SHADOW_RAYS, (loop.shadows_wait >> number & 1u) != 0u,
                        index | number << SHADOW_RAY_LIGHT_SHIFT);
    }
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes take part: appending needs the whole subgroup
    uvec4 hit = live ? loadHit(index) : kNoHit;
    // on lavapipe, a branch would cost as much as the code that it skips
    bool on_splats = !kOneBounce || (hit.z != NO_INDEX && hit.w != OWNER_SHAPES);
    SurfaceInteraction splats = noInteraction();
    if (on_splats) splats = splatInteraction(index, path, hit);
    PathLoop loop = PathLoop(path, hit, loadSums(index, 0u), live, false, false, 0u, kNoShadow, kNoQuery, 0u, 0u);
    vec4 gaussians = loadGaussianLight(index);
    if (kCameraPass) {
        SurfaceInteraction point = interactionOf(loop, splats);
        float covered = covers(point) ? 1.0 : 0.0;
        loop.sums = beginSample(loop.sums, coverageBehind(covered, gaussians),
                                albedoBehind(covered * point.albedo, gaussians, index), push.sample_index);
    }
    if (kHasGaussians && live) accumulateLight(loop.sums, passGaussians(loop.path, gaussians), bounceOf(path.bits));
    uint bounces = 0u;
    do {
        shadeBounce(loop, interactionOf(loop, splats), index);
        bounces++;
    } while (!kOneBounce && continuesLoop(loop, bounces));

    if (live) storeSums(index, 0u, loop.sums);
    bool queued = loop.queued || loop.running;
    if (queued) imageStore(hit_texels, int(index), loop.hit);
    appendRay(queued, index, loop.path);
    appendEntry(LIST_INSTANCE_RAYS, loop.ray_waits, index);
    queueShadowRays(loop, index);
    loop.rays -= loop.running ? 1u : 0u; // prepare counts the rays of the queue
    uint rays = subgroupAdd(loop.rays), shadows = subgroupAdd(loop.shadow_rays);
    if (subgroupElect() && rays > 0u) atomicAdd(control.secondary_rays, rays);
    if (subgroupElect() && shadows > 0u) atomicAdd(control.shadow_rays, shadows);
}
