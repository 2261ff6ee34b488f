// SPDX-License-Identifier: Apache-2.0
// Denoiser, second pass: replaces pixels that are not finite by the mean of their neighbours, clamps fireflies to the
// brightness of their neighbours, finds the luminance that guides the filter, and estimates the slope of the surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/denoise_grid.glsl"
#include "shaders/display/denoise_surface.glsl"
#include "shaders/shared/bindings.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(push_constant) uniform Push { ivec4 push; }; // x, y: size of the image

layout(binding = BINDING_DENOISE_LIGHT) uniform samplerBuffer light_texels;      // rgb: light, a: variance
layout(binding = BINDING_DENOISE_SURFACES) uniform samplerBuffer surface_texels; // DenoiseSurface
layout(std430, binding = BINDING_DENOISE_LIGHT_OUT) writeonly buffer LightBuffer { vec4 lights[]; };
layout(std430, binding = BINDING_DENOISE_SLOPES_OUT) writeonly buffer SlopeBuffer { vec2 slopes[]; };
layout(std430, binding = BINDING_DENOISE_GUIDE_LIGHT_OUT) writeonly buffer GuideBuffer { float guides[]; };

// A firefly is more than this many times as bright as its second brightest neighbour, which happens with exponentially
// distributed noise in 1 pixel of 430 (the product of k/(k+6) for k from 2 to 8) ...
const float kFireflyRatio = 6.0;
// ... and its relative standard deviation is larger than this: if one sample of n is bright, the deviation of the mean
// equals the mean.
const float kFireflyDeviation = 0.25;

// The valid neighbours.
struct Neighbours {
    vec4 sum; // light and variance
    float count;
    float brightest, second;
    float shown[9]; // luminance, by place in the 3x3 pixels; for missing ones see addNeighbour
    float missing;  // luminance to store for the next missing neighbour
};

// Missing neighbours are alternately darker and brighter than all others, so that they hardly move the median.
void addNeighbour(inout Neighbours around, DenoiseSurface center, ivec2 pixel, int place) {
    int texel = texelOf(pixel, push.xy);
    vec4 light = texelFetch(light_texels, texel);
    vec4 words = texelFetch(surface_texels, texel);
    // Empty pixels are valid neighbours of each other, so that those that are not finite can be repaired.
    bool counts = isInside(pixel, push.xy) && words.w == center.kind && words.w >= 0.0;
    float shown = counts ? luminance(light.rgb) : 0.0;
    around.sum += counts ? light : vec4(0.0);
    around.count += counts ? 1.0 : 0.0;
    around.second = max(around.second, min(around.brightest, shown));
    around.brightest = max(around.brightest, shown);
    around.shown[place] = counts ? shown : around.missing;
    around.missing = counts ? around.missing : -around.missing;
}

// In two loops, since the pixel between them is not a neighbour.
Neighbours neighboursOf(DenoiseSurface center, ivec2 pixel) {
    Neighbours around;
    around.sum = vec4(0.0);
    around.count = around.brightest = around.second = 0.0;
    around.missing = -2.0 * kBrightest;
    for (int i = 0; i < 4; ++i) addNeighbour(around, center, pixel + ivec2(i % 3 - 1, i / 3 - 1), i);
    for (int i = 5; i < 9; ++i) addNeighbour(around, center, pixel + ivec2(i % 3 - 1, i / 3 - 1), i);
    return around;
}

vec4 repaired(vec4 light, DenoiseSurface center, Neighbours around) {
    if (center.broken) return around.count > 0.0 ? around.sum / around.count : vec4(0.0);
    float shown = luminance(light.rgb);
    bool firefly = center.kind != KIND_EMPTY && around.count >= 3.0 && shown > kFireflyRatio * around.second &&
                   light.a > kFireflyDeviation * kFireflyDeviation * shown * shown;
    float scale = firefly ? around.second / shown : 1.0;
    return light * vec4(vec3(scale), scale * scale);
}

void sortPair(inout float low, inout float high) {
    float least = min(low, high);
    high = max(low, high);
    low = least;
}

// Median of the luminance of the pixel and its neighbours (the lower median of an even number), by a sorting network
// that sorts only as much as needed (Smith, Implementing median filters in XC4000E FPGAs, 1996).
float medianAround(Neighbours around, float own) {
    float v[9] = around.shown;
    v[4] = own;
    sortPair(v[1], v[2]), sortPair(v[4], v[5]), sortPair(v[7], v[8]);
    sortPair(v[0], v[1]), sortPair(v[3], v[4]), sortPair(v[6], v[7]);
    sortPair(v[1], v[2]), sortPair(v[4], v[5]), sortPair(v[7], v[8]);
    sortPair(v[0], v[3]), sortPair(v[5], v[8]), sortPair(v[4], v[7]);
    sortPair(v[3], v[6]), sortPair(v[1], v[4]), sortPair(v[2], v[5]);
    sortPair(v[4], v[7]), sortPair(v[4], v[2]), sortPair(v[6], v[4]);
    sortPair(v[4], v[2]);
    return v[4];
}

// The luminance that guides the filter: the pixel's own, moved towards the median as far as its noise explains the
// difference. A bright sample among n makes its pixel stand out by one standard deviation of the mean, so its guide is
// its neighbours' light, and the filter spreads the sample over them instead of leaving a speck.
float guideOf(vec4 light, Neighbours around) {
    float own = luminance(light.rgb), deviation = sqrt(light.a);
    return clamp(medianAround(around, own), own - deviation, own + deviation);
}

// The smaller of the differences to both sides, since the larger one may cross an edge.
float slopeBetween(DenoiseSurface center, ivec2 before, ivec2 after) {
    float a = texelFetch(surface_texels, texelOf(before, push.xy)).z;
    float b = texelFetch(surface_texels, texelOf(after, push.xy)).z;
    float back = center.closeness - a, forth = b - center.closeness;
    bool has_back = isInside(before, push.xy) && a > 0.0, has_forth = isInside(after, push.xy) && b > 0.0;
    float slope = has_back && (!has_forth || abs(back) < abs(forth)) ? back : forth;
    return has_back || has_forth ? slope : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel, push.xy)) return;
    int texel = texelOf(pixel, push.xy);
    DenoiseSurface center = unpackSurface(texelFetch(surface_texels, texel));
    Neighbours around = neighboursOf(center, pixel);
    vec4 light = repaired(texelFetch(light_texels, texel), center, around);
    lights[texel] = light;
    guides[texel] = guideOf(light, around);
    vec2 slope = vec2(slopeBetween(center, pixel - ivec2(1, 0), pixel + ivec2(1, 0)),
                      slopeBetween(center, pixel - ivec2(0, 1), pixel + ivec2(0, 1)));
    slopes[texel] = center.closeness > 0.0 ? slope : vec2(0.0);
}
