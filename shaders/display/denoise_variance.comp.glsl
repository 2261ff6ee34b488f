// SPDX-License-Identifier: Apache-2.0
// Denoiser, third pass: the variance of each pixel's light. The estimate of a single pixel from few samples is itself
// noisy, so it is averaged with those of its neighbours, as a standard deviation, to keep a few pixels of high variance
// (such as an edge in a reflection) from dominating. Without estimates, the spatial variance of the light among the
// neighbours is used.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/denoise_grid.glsl"
#include "shaders/display/denoise_surface.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/shared/spec_constants.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(constant_id = SPEC_KNOWS_VARIANCE) const uint KNOWS_VARIANCE = 1;
layout(push_constant) uniform Push { // x, y: size of the image
    ivec4 push;
    vec4 angles; // x: angle of a pixel, radians
};

layout(binding = BINDING_DENOISE_LIGHT) uniform samplerBuffer light_texels;   // rgb: light, a: variance
layout(binding = BINDING_DENOISE_SURFACES) uniform samplerBuffer surface_texels; // DenoiseSurface
layout(binding = BINDING_DENOISE_SLOPES) uniform samplerBuffer slope_texels;
layout(std430, binding = BINDING_DENOISE_LIGHT_OUT) writeonly buffer LightBuffer { vec4 lights[]; };

// Half width and step of the window: 3x3 to smooth given variances, 7x7 to measure spatial variance (as Schied et al.
// 2017 do for new pixels), where every second pixel gives the same quality in a third of the time. Given variances need
// a step of 1: with 2, bright pixels in reflections of lamps would raise only the variance of pixels of their own
// parity, and remain as lattices of dots.
const int kReach = KNOWS_VARIANCE != 0u ? 1 : 3, kStep = KNOWS_VARIANCE != 0u ? 1 : 2;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel, push.xy)) return;
    int texel = texelOf(pixel, push.xy);
    vec4 light = texelFetch(light_texels, texel);
    DenoiseSurface center = unpackSurface(texelFetch(surface_texels, texel));
    vec2 slope = texelFetch(slope_texels, texel).xy;
    float center_light = luminance(light.rgb);
    float total = 1.0, deviations = sqrt(light.a), sum = 0.0, squares = 0.0; // of differences to the pixel's light
    ivec2 at = ivec2(-kReach);
    while (at.y <= kReach) {
        ivec2 other = pixel + at;
        int tap = texelOf(other, push.xy);
        vec4 tap_light = texelFetch(light_texels, tap);
        DenoiseSurface surface = unpackSurface(texelFetch(surface_texels, tap));
        bool counts = isInside(other, push.xy) && sameKind(center, surface) && at != ivec2(0);
        float weight = counts ? exp(-surfaceDistance(center, slope, surface, vec2(at), angles.x)) : 0.0;
        float difference = luminance(tap_light.rgb) - center_light;
        total += weight;
        deviations += weight * sqrt(tap_light.a);
        sum += weight * difference;
        squares += weight * difference * difference;
        at.x += kStep;
        if (at.x > kReach) at = ivec2(-kReach, at.y + kStep);
    }
    float mean = sum / total;
    float spread = max(0.0, squares / total - mean * mean), deviation = deviations / total;
    lights[texel] = vec4(light.rgb, KNOWS_VARIANCE != 0u ? deviation * deviation : spread);
}
