// SPDX-License-Identifier: Apache-2.0
// Composites an instance of Gaussians in front of the closest hit of each ray: their light, and how much passes from
// behind.
//
// Captures are trained with colours that are display-encoded, so Gaussians are composited so, and the result is decoded
// once. Over a plain background it is encoded, too, as in viewers of such captures.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/path.glsl"
#include "shaders/shade/sky.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shared/tone_curve.h"
#include "shaders/trace/gaussian_hits.glsl"
#include "shaders/shade/harmonics.glsl"

// Light in front of a ray's hit, display-encoded, and the share that passes.
struct Composite {
    vec3 light;
    float transmittance;
};

void addGaussian(inout Composite sum, GaussianHit hit, vec3 direction) {
    bool is_hit = hit.gaussian != NO_INDEX;
    uint gaussian = is_hit ? hit.gaussian : 0u;
    vec4 look = loadGaussianRow(gaussian, 3u);
    vec3 color = max(look.yzw + harmonicsAlong(gaussian, direction), vec3(0.0));
    float alpha = is_hit ? alphaAt(look.x, hit.distance_squared) : 0.0;
    sum.light += sum.transmittance * alpha * color;
    sum.transmittance *= 1.0 - alpha;
}

Composite compositeAlong(GaussianRay ray, bool enters, bool live, Composite sum) {
    GaussianHits hits = startGaussianHits(ray, enters);
    bool going;
    do {
        going = live && mayGoOn(hits) && sum.transmittance >= GAUSSIAN_TRANSMITTANCE_MIN;
        addGaussian(sum, nextHit(hits, enters, going), ray.direction);
    } while (going);
    return sum;
}

// Linear light, for what lies behind to be added with the share that passes. background: what the ray sees there if it
// hits nothing.
vec3 decoded(Composite sum, bool misses) {
    bool plain = !kSkyImage && params.sky_zenith == params.sky_horizon && params.sky_ground == params.sky_horizon;
    float behind = sum.transmittance;
    vec3 background = params.sky_horizon;
    vec3 over = exactLinearFromSrgb(sum.light + behind * srgbFromLinear(background)) - behind * background;
    float covered = 1.0 - behind;
    vec3 alone = covered > 0.0 ? covered * exactLinearFromSrgb(sum.light / covered) : vec3(0.0);
    return plain && misses && !hasOption(OPTION_TRANSPARENT) ? over : alone;
}

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX, enters;
    uvec4 hit = live ? loadHit(index) : kNoHit;
    GaussianRay ray = gaussianRay(path.origin, path.direction, uintBitsToFloat(hit.x) * cubeScale(), enters);
    Composite sum = Composite(vec3(0.0), 1.0);
    if (live && !hasStep(STEP_FIRST)) sum = Composite(gaussian_light[index].rgb, gaussian_light[index].a);
    sum = compositeAlong(ray, enters, live, sum);
    if (sum.transmittance < GAUSSIAN_TRANSMITTANCE_MIN) sum.transmittance = 0.0;
    vec3 light = hasStep(STEP_LAST) ? decoded(sum, hit.z == NO_INDEX) : sum.light;
    if (live) gaussian_light[index] = vec4(light, sum.transmittance);
}
