// SPDX-License-Identifier: Apache-2.0
// Denoiser, one wavelet level: an edge-avoiding a-trous wavelet (Dammertz, Sewtz, Hanika, Lensch, Edge-Avoiding A-Trous
// Wavelet Transform for fast Global Illumination Filtering, HPG 2010) with a luminance weight guided by the variance of
// the light (Schied et al., Spatiotemporal Variance-Guided Filtering, HPG 2017).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/denoise_grid.glsl"
#include "shaders/display/denoise_surface.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/shared/spec_constants.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(constant_id = SPEC_IS_LAST_LEVEL) const uint IS_LAST = 0;
layout(push_constant) uniform Push { // x, y: size of the image, z: pixels between taps
    ivec4 push;
    vec4 angles; // x: angle of a pixel, radians
};

layout(binding = BINDING_DENOISE_COLORS) uniform samplerBuffer color_texels;     // rgb: colour before the filter
layout(binding = BINDING_DENOISE_LIGHT) uniform samplerBuffer light_texels;      // rgb: light, a: variance
layout(binding = BINDING_DENOISE_SURFACES) uniform samplerBuffer surface_texels; // DenoiseSurface
layout(binding = BINDING_DENOISE_SLOPES) uniform samplerBuffer slope_texels;
layout(binding = BINDING_DENOISE_FACTORS) uniform samplerBuffer factor_texels;    // rgb: albedo divided out, a: alpha
layout(binding = BINDING_DENOISE_GUIDE_LIGHT) uniform samplerBuffer guide_texels; // luminance: denoise_clean.comp.glsl
layout(std430, binding = BINDING_DENOISE_LIGHT_OUT) writeonly buffer LightBuffer { vec4 lights[]; };
layout(std430, binding = BINDING_DENOISE_GUIDE_LIGHT_OUT) writeonly buffer GuideBuffer { float guides[]; };

// Squared luminance differences are measured in units of this many variances. The variance is the geometric mean of
// both pixels': weights are then symmetric and preserve the mean, and a pixel of zero variance, common in mirrors, is
// neither changed nor spread.
const float kVarianceScale = 16.0;

// Surfaces count as different if their surfaceDistance is larger than this, a weight of exp(-2) = 0.14.
const float kOtherSurface = 2.0;
// Below this ratio of albedos, the error of a mixed pixel at an outline is too small to be visible.
const float kAlbedoContrast = 1.5;

struct Sum {
    vec4 light;  // weighted sum; variance weighted by squared weights
    float guide; // weighted sum
    float weight;
};

void addTap(inout Sum sum, vec4 light, float guide, DenoiseSurface center, vec2 slope, ivec2 pixel, ivec2 offset,
            float kernel) {
    ivec2 other = pixel + offset;
    int texel = texelOf(other, push.xy);
    vec4 tap = texelFetch(light_texels, texel);
    DenoiseSurface surface = unpackSurface(texelFetch(surface_texels, texel));
    float tap_guide = texelFetch(guide_texels, texel).x, difference = tap_guide - guide;
    float variance = sqrt(light.a * tap.a);
    float dissimilarity = difference * difference / (kVarianceScale * variance + 1e-20) +
                          surfaceDistance(center, slope, surface, vec2(offset), angles.x);
    // Without the last term, a converged pixel would inherit the variance of a noisier neighbour of equal colour.
    bool counts = isInside(other, push.xy) && sameKind(center, surface) && variance > 0.0;
    float weight = counts ? kernel * exp(-dissimilarity) : 0.0;
    sum.light += tap * vec4(vec3(weight), weight * weight);
    sum.guide += tap_guide * weight;
    sum.weight += weight;
}

// The range of luminance around a pixel before the filter (second_low to second_high: without the darkest and the
// brightest neighbour, which may be noise); and whether another surface is there.
struct Surroundings {
    float low, second_low, high, second_high;
    bool has_outline;
};

ivec2 neighbour(int i) { return ivec2(i % 3 - 1, i / 3 - 1); }

// Whether albedos around the pixel differ so much that outlines that mix them need outlineScale.
bool albedosDiffer(ivec2 pixel) {
    float least = kBrightest, largest = 0.0;
    for (int i = 0; i < 9; ++i) { // positions beyond the picture are clamped to its border
        float factor = luminance(texelFetch(factor_texels, texelOf(pixel + neighbour(i), push.xy)).rgb);
        least = min(least, factor);
        largest = max(largest, factor);
    }
    return largest > kAlbedoContrast * least;
}

void addSurroundings(inout Surroundings around, DenoiseSurface center, vec2 slope, ivec2 pixel, ivec2 offset) {
    ivec2 other = pixel + offset;
    if (!isInside(other, push.xy)) return;
    int texel = texelOf(other, push.xy);
    DenoiseSurface surface = unpackSurface(texelFetch(surface_texels, texel));
    around.has_outline = around.has_outline || !sameKind(center, surface) ||
                         surfaceDistance(center, slope, surface, vec2(offset), angles.x) > kOtherSurface;
    float shown = luminance(texelFetch(color_texels, texel).rgb);
    if (surface.broken) return;
    around.second_high = max(around.second_high, min(around.high, shown));
    around.high = max(around.high, shown);
    around.second_low = min(around.second_low, max(around.low, shown));
    around.low = min(around.low, shown);
}

// Factor for a filtered colour. A pixel on the outline of a body shows two surfaces, and its light was divided by the
// mean of their albedos. Where glass (albedo 1) meets a dark floor, the quotient is far less than the floor's, so
// filtering would make the outline many times too bright. There the colour is clamped to the range around the pixel.
float outlineScale(float filtered, DenoiseSurface center, vec2 slope, ivec2 pixel) {
    Surroundings around = Surroundings(kBrightest, kBrightest, 0.0, 0.0, false);
    int count = albedosDiffer(pixel) ? 9 : 0; // lavapipe skips a loop that no lane needs, but not a branch
    for (int i = 0; i < count; ++i) addSurroundings(around, center, slope, pixel, neighbour(i));
    if (!around.has_outline || center.broken || !(filtered > 0.0)) return 1.0;
    float own = luminance(texelFetch(color_texels, texelOf(pixel, push.xy)).rgb);
    return clamp(filtered, min(own, around.second_low), max(own, around.second_high)) / filtered;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel, push.xy)) return;
    int texel = texelOf(pixel, push.xy), stride = push.z;
    vec4 light = texelFetch(light_texels, texel);
    float guide = texelFetch(guide_texels, texel).x;
    DenoiseSurface center = unpackSurface(texelFetch(surface_texels, texel));
    vec2 slope = texelFetch(slope_texels, texel).xy;
    // The kernel is (1 2 1)/4 in both directions, scaled to 1 at the centre.
    Sum sum = Sum(light, guide, 1.0);
    addTap(sum, light, guide, center, slope, pixel, ivec2(-stride, -stride), 0.25);
    addTap(sum, light, guide, center, slope, pixel, ivec2(0, -stride), 0.5);
    addTap(sum, light, guide, center, slope, pixel, ivec2(stride, -stride), 0.25);
    addTap(sum, light, guide, center, slope, pixel, ivec2(-stride, 0), 0.5);
    addTap(sum, light, guide, center, slope, pixel, ivec2(stride, 0), 0.5);
    addTap(sum, light, guide, center, slope, pixel, ivec2(-stride, stride), 0.25);
    addTap(sum, light, guide, center, slope, pixel, ivec2(0, stride), 0.5);
    addTap(sum, light, guide, center, slope, pixel, ivec2(stride, stride), 0.25);
    vec4 filtered = sum.light / vec4(vec3(sum.weight), sum.weight * sum.weight);
    if (IS_LAST != 0u) {
        vec4 factor = texelFetch(factor_texels, texel);
        vec3 color = filtered.rgb * factor.rgb;
        filtered = vec4(color * outlineScale(luminance(color), center, slope, pixel), factor.a);
    } else {
        guides[texel] = sum.guide / sum.weight;
    }
    lights[texel] = filtered;
}
