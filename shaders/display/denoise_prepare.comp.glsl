// SPDX-License-Identifier: Apache-2.0
// Denoiser, first pass: divides the light by the albedo and classifies pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/denoise_grid.glsl"
#include "shaders/display/denoise_surface.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/shared/spec_constants.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(constant_id = SPEC_KNOWS_VARIANCE) const uint KNOWS_VARIANCE = 1;
layout(push_constant) uniform Push { ivec4 push; }; // x, y: size of the image

layout(binding = BINDING_DENOISE_COLORS) uniform samplerBuffer color_texels;   // rgb: colour, a: alpha
layout(binding = BINDING_DENOISE_GUIDES) uniform samplerBuffer surface_texels; // xyz: normal, w: depth
layout(binding = BINDING_DENOISE_ALBEDOS) uniform samplerBuffer albedo_texels; // rgb: albedo, a: variance of the mean
layout(std430, binding = BINDING_DENOISE_LIGHT_OUT) writeonly buffer LightBuffer { vec4 lights[]; };
layout(std430, binding = BINDING_DENOISE_SURFACES_OUT) writeonly buffer SurfaceBuffer { vec4 surfaces[]; };
// rgb: albedo divided out, a: alpha
layout(std430, binding = BINDING_DENOISE_FACTORS_OUT) writeonly buffer AlbedoBuffer { vec4 factors[]; };

// Lower limit of the divisor: surfaces of lower albedo mostly show gloss.
const float kAlbedoFloor = 1.0 / 64.0;

vec3 factorOf(vec3 albedo) {
    return all(equal(albedo, vec3(0.0))) ? vec3(1.0) : max(albedo, vec3(kAlbedoFloor));
}

float kindOf(float alpha, vec3 albedo) {
    if (!(alpha > 0.0)) return KIND_EMPTY;
    // Mean coverage may differ from 1 by rounding, but one uncovered sample of 65,536 makes a larger difference.
    float covered = alpha > 1.0 - 1e-5 ? KIND_FULL : KIND_EMPTY + clamp(ceil(alpha * 8.0), 1.0, 7.0);
    return all(equal(albedo, vec3(0.0))) ? covered + KIND_BLACK : covered;
}

DenoiseSurface surfaceOf(vec4 normal_depth, float kind, bool broken) {
    vec3 normal = normal_depth.xyz;
    float depth = normal_depth.w;
    bool has_normal = isFinite(normal) && dot(normal, normal) > 0.25;
    bool has_depth = isFinite(depth) && depth > 0.0;
    return DenoiseSurface(has_normal ? normalize(normal) : vec3(0.0, 0.0, 1.0), has_depth ? 1.0 / depth : 0.0, kind,
                          broken);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel, push.xy)) return;
    int texel = texelOf(pixel, push.xy);
    vec4 color = texelFetch(color_texels, texel), albedo = texelFetch(albedo_texels, texel);
    vec3 reflectance = isFinite(albedo.rgb) ? max(albedo.rgb, vec3(0.0)) : vec3(0.0);
    float kind = kindOf(isFinite(color.a) ? color.a : 0.0, reflectance);
    vec3 factor = kind == KIND_EMPTY ? vec3(1.0) : factorOf(reflectance);
    bool broken = !isFinite(color.rgb);
    vec3 light = broken ? vec3(0.0) : clamp(color.rgb / factor, -kBrightest, kBrightest);
    float lit = luminance(light), scale = luminance(factor);
    // an unknown variance is assumed to be as large as the light itself
    bool known = KNOWS_VARIANCE != 0u && isFinite(albedo.a) && albedo.a >= 0.0;
    float variance = known ? min(albedo.a / (scale * scale), kBrightest * kBrightest) : lit * lit;
    lights[texel] = vec4(light, variance);
    surfaces[texel] = packSurface(surfaceOf(texelFetch(surface_texels, texel), kind, broken));
    factors[texel] = vec4(factor, color.a);
}
