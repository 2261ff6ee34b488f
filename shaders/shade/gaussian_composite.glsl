// SPDX-License-Identifier: Apache-2.0
// Shared by all programs that composite Gaussians, of one instance or of several.
#ifndef POINTRT_SHADERS_GAUSSIAN_COMPOSITE_GLSL
#define POINTRT_SHADERS_GAUSSIAN_COMPOSITE_GLSL
#include "shaders/lib/color.glsl"
#include "shaders/lib/path.glsl"
#include "shaders/shade/harmonics.glsl"
#include "shaders/shade/sky.glsl"
#include "shaders/shade/surface_view.glsl"
#include "shaders/shared/tone_curve.h"
#include "shaders/trace/gaussian_first_hit.glsl"
#include "shaders/trace/gaussian_rounds.glsl"

bool passesLight(float transmittance) { return transmittance >= GAUSSIAN_TRANSMITTANCE_MIN; }

// The display-encoded colour of a Gaussian along a ray; the albedo if the scene lights Gaussians.
vec3 gaussianColor(uint gaussian, vec4 look, vec3 direction) {
    return max(kRelights ? look.yzw : look.yzw + harmonicsAlong(gaussian, direction), vec3(0.0));
}

// Linear light, to which the light from behind is then added, times the share that passes. misses: behind the Gaussians
// the ray sees only the background.
vec3 decodedLight(vec3 encoded, float passes, bool misses) {
    bool plain = !kSkyImage && params.sky_zenith == params.sky_horizon && params.sky_ground == params.sky_horizon;
    vec3 background = params.sky_horizon;
    vec3 over = exactLinearFromSrgb(encoded + passes * srgbFromLinear(background)) - passes * background;
    float covered = 1.0 - passes;
    vec3 alone = covered > 0.0 ? covered * exactLinearFromSrgb(encoded / covered) : vec3(0.0);
    return plain && misses && !hasOption(OPTION_TRANSPARENT) && !kRelights ? over : alone;
}

// The integrators normal and depth show a ray's middle as an opaque surface. Rays without a middle see through.
// light: of the Gaussians, and the share that passes; middle: of GaussianLight
vec4 surfaceViewOf(vec4 light, vec4 middle) {
    if (kShading != SHADING_NORMAL && kShading != SHADING_DEPTH) return light;
    vec3 color = kShading == SHADING_DEPTH ? depthColor(middle.w) : normalColor(normalize(middle.xyz));
    return middle.w < kWalkEnded ? vec4(color, 0.0) : vec4(vec3(0.0), 1.0);
}

// The radius by which shadow rays of lit Gaussians are offset (shaders/trace/offset.glsl): about one standard deviation
// along the axis of middle length, a third of its half length. A surface is a layer of overlapping Gaussians that do
// not lie in one plane.
float radiusOf(uint gaussian) {
    vec3 x = loadGaussianRow(gaussian, 0u).xyz, y = loadGaussianRow(gaussian, 1u).xyz;
    vec3 z = loadGaussianRow(gaussian, 2u).xyz;
    vec3 squares = vec3(dot(x, x), dot(y, y), dot(z, z)); // of the inverse half lengths
    float middle = max(min(squares.x, squares.y), min(max(squares.x, squares.y), squares.z));
    return 1.0 / (3.0 * sqrt(middle) * cubeScale());
}

// Stores the surface data of lit Gaussians in the members of GaussianLight. normal: the sum of normals; most: the most
// that one Gaussian adds
void storeSurface(vec3 normal, float most, bool complete, float radius, vec3 light, inout vec4 next, inout vec4 middle) {
    if (!kRelights) return;
    float length_squared = dot(normal, normal);
    middle.xyz = complete && length_squared > 0.0 ? normal * (radius / sqrt(length_squared)) : normal;
    if (length_squared == 0.0) middle.w = kWalkEnded;
    next.yzw = complete ? light : vec3(next.y, most, radius);
}

#endif
