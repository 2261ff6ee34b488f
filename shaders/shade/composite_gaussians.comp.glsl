// SPDX-License-Identifier: Apache-2.0
// Composites an instance of Gaussians in front of the closest hit of each ray: their light, and how much passes from
// behind.
//
// Captures are trained with display-encoded colours, so Gaussians are composited in that encoding, and the result is
// decoded once. A plain background is composited in that encoding, too, as other viewers of captures do.
//
// If the scene lights Gaussians, each ray sees one surface, where it meets the Gaussian that adds most: with the
// composited normals, and with the composited constant terms as its albedo (deferred shading).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/shade/gaussian_composite.glsl"

// Light in front of a ray's hit, display-encoded, and the share that passes.
struct Composite {
    vec3 light;
    float transmittance;
    // if in this instance: the hit behind which less than half passes, or for lit Gaussians the hit that adds most
    GaussianHit middle;
    float most;         // the most that one Gaussian adds; this and the next only for lit Gaussians
    vec3 normal;        // sum of the normals in render space, each times what its Gaussian adds
};

void addGaussian(inout Composite sum, GaussianHit hit, vec3 direction) {
    bool is_hit = hit.gaussian != NO_INDEX;
    uint gaussian = is_hit ? hit.gaussian : 0u;
    vec4 look = loadGaussianRow(gaussian, 3u);
    vec3 color = gaussianColor(gaussian, look, direction);
    float alpha = is_hit ? alphaAt(look.x, hit.distance_squared) : 0.0;
    float added = sum.transmittance * alpha;
    sum.light += sum.transmittance * alpha * color;
    float passes = sum.transmittance * (1.0 - alpha);
    if (kRelights ? added > sum.most : sum.transmittance > kHalf && passes <= kHalf) sum.middle = hit;
    if (kRelights) sum.most = max(sum.most, added);
    if (kRelights) sum.normal += added * renderDirection(normalize(gaussianNormal(gaussian, direction)));
    sum.transmittance = passes;
}

bool isTransparent(Composite sum) { return passesLight(sum.transmittance); }

// Returns whether lavapipe has ended the loops, which may run 65,535 iterations together. The hits up to hits.last have
// then been added.
bool compositeAlong(inout GaussianHits hits, bool enters, bool live, inout Composite sum) {
    bool going, lives = live;
    do {
        do {
            going = lives && mayContinue(hits) && isTransparent(sum);
            addGaussian(sum, nextHit(hits, going), hits.ray.direction);
        } while (going);
        lives = restartIfLost(hits, enters, lives && isTransparent(sum));
    } while (lives);
    return live && (mayContinue(hits) || hits.lost.gaussian != NO_INDEX) && isTransparent(sum);
}

// In the form that GaussianLight stores.
vec4 middleOf(GaussianRay ray, GaussianHit hit) {
    vec3 normal = renderDirection(normalize(gaussianNormal(hit.gaussian, ray.direction)));
    return vec4(normal, (ray.t_start + hit.t) / cubeScale());
}

void main() {
    uint index;
    PathState path = pathOfRound(index);
    bool live = index != NO_INDEX, enters;
    uvec4 hit = live ? loadHit(index) : kNoHit;
    GaussianRay ray = gaussianRay(path.origin, path.direction, uintBitsToFloat(hit.x) * cubeScale(), enters);
    GaussianLight stored = GaussianLight(vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), vec4(vec3(0.0), kWalkEnded));
    if (live && (!hasStep(STEP_FIRST) || hasStep(STEP_RESUME))) stored = gaussian_light[index];
    GaussianHit last = GaussianHit(ray.t_min, NO_INDEX, 0.0);
    if (hasStep(STEP_RESUME)) last = GaussianHit(stored.last.x, floatBitsToUint(stored.last.y), 0.0);

    GaussianHits hits = resumeGaussianHits(ray, enters, last);
    Composite sum = Composite(stored.light.rgb, stored.light.a, kNoGaussianHit, kRelights ? stored.last.z : 0.0,
                              kRelights ? stored.middle.xyz : vec3(0.0));
    bool cut = compositeAlong(hits, enters, live, sum);
    bool ends = !cut || hasStep(STEP_FINAL);
    if (!isTransparent(sum)) sum.transmittance = 0.0;
    bool complete = hasStep(STEP_LAST) && ends;
    vec3 light = complete ? decodedLight(sum.light, sum.transmittance, hit.z == NO_INDEX) : sum.light;
    vec4 next = vec4(ends ? kWalkEnded : hits.last.t, uintBitsToFloat(hits.last.gaussian), 0.0, 0.0);
    bool has_middle = sum.middle.gaussian != NO_INDEX;
    vec4 middle = has_middle ? middleOf(ray, sum.middle) : stored.middle;
    float radius = kRelights && has_middle ? radiusOf(sum.middle.gaussian) : stored.last.w;
    storeSurface(sum.normal, sum.most, complete, radius, light, next, middle);
    vec4 seen = vec4(light, sum.transmittance);
    if (complete) seen = surfaceViewOf(seen, middle);
    if (live) gaussian_light[index] = GaussianLight(seen, next, middle);
    listForNextRound(live && !ends, index);
    if (cut && ends) atomicAdd(control.cut_rays, 1u);
}
