// SPDX-License-Identifier: Apache-2.0
// First hits of a batch of rays with one instance of Gaussians: where half of the light is hidden. The splat is the
// Gaussian that adds most to the light up to there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/cast/cast_rays.glsl"
#include "shaders/lib/normal_word.glsl"
#include "shaders/trace/gaussian_first_hit.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    LoadedRay loaded = loadRay(row);
    TraceRay in_cube = instanceRay(loaded.ray);
    bool enters;
    GaussianRay ray = gaussianRayInCube(in_cube.origin, in_cube.direction, in_cube.t_max, enters);
    FirstHit first = firstHitAlong(ray, enters, true);
    bool is_hit = first.middle.gaussian != NO_INDEX;
    float t = is_hit ? (ray.t_start + first.middle.t) / unitsInCube() : loaded.ray.t_max;
    vec3 normal = gaussianNormal(is_hit ? first.middle.gaussian : 0u, ray.direction);
    storeHit(row, loaded, t, is_hit ? first.strongest.gaussian : NO_INDEX, normalWord(normal));
}
