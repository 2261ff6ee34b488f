// SPDX-License-Identifier: Apache-2.0
// Denoiser, third pass: how much a pixel's light can be trusted. A pixel's own estimate from a few samples is noise
// itself and is averaged with its neighbours', as deviation, so that a few uncertain pixels (an edge in a mirrored
// picture) do not count for all around; where there is none the light's spread among the neighbours stands in.
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
    vec4 angles; // x: of a pixel, radians
};

layout(binding = BINDING_DENOISE_LIGHT) uniform samplerBuffer light_texels;   // light, variance
layout(binding = BINDING_DENOISE_SURFACES) uniform samplerBuffer surface_texels; // DenoiseSurface
layout(binding = BINDING_DENOISE_SLOPES) uniform samplerBuffer slope_texels;
layout(std430, binding = BINDING_DENOISE_LIGHT_OUT) writeonly buffer LightBuffer { vec4 lights[]; };

// Of the window: 5x5 smooths given variances, 7x7 measures spreads (as Schied et al. 2017 do for new pixels). Every
// second pixel of it stands for all: a third of the time, and pictures as good.
const int kReach = KNOWS_VARIANCE != 0u ? 2 : 3;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel, push.xy)) return;
    int texel = texelOf(pixel, push.xy);
    vec4 light = texelFetch(light_texels, texel);
    DenoiseSurface center = unpackSurface(texelFetch(surface_texels, texel));
    vec2 slope = texelFetch(slope_texels, texel).xy;
    float own = luminance(light.rgb);
    float total = 1.0, deviations = sqrt(light.a), sum = 0.0, squares = 0.0; // of differences to the pixel's own light
    ivec2 at = ivec2(-kReach);
    while (at.y <= kReach) {
        ivec2 other = pixel + at;
        int tap = texelOf(other, push.xy);
        vec4 tap_light = texelFetch(light_texels, tap);
        DenoiseSurface surface = unpackSurface(texelFetch(surface_texels, tap));
        bool counts = isInside(other, push.xy) && sameKind(center, surface) && at != ivec2(0);
        float weight = counts ? exp(-surfaceDistance(center, slope, surface, vec2(at), angles.x)) : 0.0;
        float difference = luminance(tap_light.rgb) - own;
        total += weight;
        deviations += weight * sqrt(tap_light.a);
        sum += weight * difference;
        squares += weight * difference * difference;
        at.x += 2;
        if (at.x > kReach) at = ivec2(-kReach, at.y + 2);
    }
    float mean = sum / total;
    float spread = max(0.0, squares / total - mean * mean), deviation = deviations / total;
    lights[texel] = vec4(light.rgb, KNOWS_VARIANCE != 0u ? deviation * deviation : spread);
}
