// SPDX-License-Identifier: Apache-2.0
// Several instances of Gaussians are composited in rounds. In each round and for each instance, this program gathers
// the first Gaussians along a ray behind those that have been composited. Then blend_gaussians or blend_first_hits
// composites them in their order along the ray, across all instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/lib/normal_word.glsl"
#include "shaders/shade/gaussian_composite.glsl"
#include "shaders/shared/film_parts.h"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/waiting_gaussians.glsl"

// Margin, relative to the distance and to the cube: the walk begins this much before the last Gaussian composited and
// ends this much behind the farthest waiting one, since stored distances have been rounded twice.
const float kSlack = 4e-6;

// A distance in render units along the ray, converted to cube units from where the ray enters the cube, minus or plus
// the margin.
float earlier(float t, GaussianRay ray) { return t * cubeScale() - ray.t_start - kSlack * (1.0 + t * cubeScale()); }
float later(float t, GaussianRay ray) { return t * cubeScale() - ray.t_start + kSlack * (1.0 + t * cubeScale()); }

// The colour of a Gaussian; for first hits, its owner in place of the colour.
void storeLook(inout WaitingGaussian waiting, GaussianHit hit, vec3 direction) {
    vec4 look = loadGaussianRow(hit.gaussian, 3u);
    uint opacity = packUnorm2x16(vec2(0.0, alphaAt(look.x, hit.distance_squared)));
    vec3 color = gaussianColor(hit.gaussian, look, direction);
    waiting.instance |= kRelights ? packHalf2x16(vec2(0.0, radiusOf(hit.gaussian))) : 0u;
    waiting.red_green = packHalf2x16(color.rg);
    waiting.blue_opacity = packHalf2x16(vec2(color.b, 0.0)) | opacity;
    if (hasStep(STEP_FIRST_HITS)) {
        waiting.red_green = instance.materials.x | instance.grid_origin.w << HIT_TILE_SHIFT;
        waiting.blue_opacity = instance.materials.y | opacity;
    }
    waiting.normal = normalWord(renderDirection(gaussianNormal(hit.gaussian, direction)));
}

void gatherAlong(uint path, inout GaussianHits hits, inout uint count, bool live) {
    WaitingGaussian last = lastComposited(path);
    bool going;
    do {
        going = live && !hasWalked(hits);
        nextList(hits, going);
        GaussianHit hit = nextPeak(hits, going);
        bool is_hit = hit.gaussian != NO_INDEX;
        WaitingGaussian found = last;
        found.t = (hits.ray.t_start + hit.t) / cubeScale();
        found.gaussian = hit.gaussian;
        found.instance = instance.grid_size.w;
        bool waits = is_hit && isBefore(last, found);
        if (waits) storeLook(found, hit, hits.ray.direction);
        float farthest = insertWaiting(path, found, waits, count);
        hits.lost.t = min(hits.lost.t, later(farthest, hits.ray));
    } while (going);
    if (live && !hasWalked(hits)) atomicAdd(control.cut_rays, 1u); // lavapipe has ended the loops
}

void main() {
    uint index;
    PathState path = pathOfRound(index);
    bool live = index != NO_INDEX, enters, starts = hasStep(STEP_FIRST);
    index = live ? index : 0u;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(index));
    float t_max = uintBitsToFloat(loadHit(index).x);
    if (hasStep(STEP_FIRST_HITS)) t_max = first_hits[at].w >= 0.0 ? first_hits[at].w : 1e30;
    if (live && starts && !hasStep(STEP_RESUME)) startRounds(index);
    uint count = starts ? 0u : waiting_gaussians[index].count;
    GaussianRay ray = gaussianRay(path.origin, path.direction, t_max * cubeScale(), enters);
    float from = earlier(lastComposited(index).t, ray);
    if (kClipped) from = max(from, ray.t_min);
    GaussianHits hits = resumeGaussianHits(ray, enters, GaussianHit(from, 0u, 0.0));
    gatherAlong(index, hits, count, live);
    if (live) waiting_gaussians[index].count = count;
}
