// SPDX-License-Identifier: Apache-2.0
// Resolves the film's sums to means: the picture of the film part to show, and the denoiser's guides.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/color.glsl"
#include "shaders/shared/display_layout.h"
#include "shaders/shared/film_parts.h"
#include "shaders/shared/luminance_moments.h"
#include "shaders/shared/params.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/spec_constants.h"

layout(local_size_x = DISPLAY_GROUP) in;
layout(constant_id = SPEC_HAS_FIRST_HITS) const uint HAS_FIRST_HITS = 1;
layout(push_constant) uniform Push { ResolveParams push; };

layout(std430, binding = BINDING_RESOLVE_FILM) readonly buffer FilmBuffer { vec4 film[]; };
layout(std430, binding = BINDING_RESOLVE_FIRST_HITS) readonly buffer FirstHitBuffer { vec4 first_hits[]; };
layout(std430, binding = BINDING_RESOLVE_COLORS) writeonly buffer ColorBuffer { vec4 colors[]; };
// xyz: normal, w: depth
layout(std430, binding = BINDING_RESOLVE_SURFACES) writeonly buffer SurfaceBuffer { vec4 surfaces[]; };
// rgb: albedo, w: variance of the mean luminance
layout(std430, binding = BINDING_RESOLVE_ALBEDOS) writeonly buffer AlbedoBuffer { vec4 albedos[]; };

// Has no `if` on the number of layers: lavapipe would compile the program again for each value.
vec4 layer(uint pixel, uint which) {
    bool has_earlier = push.samples > float(FILM_BATCH);
    uint batch = which * push.film_pixels + pixel;
    vec4 earlier = film[batch + (has_earlier ? FILM_LAYERS : 0u) * push.film_pixels];
    return film[batch] + mix(vec4(0.0), earlier, bvec4(has_earlier));
}

// The film at a pixel.
struct Pixel {
    uint number;
    vec3 beauty;
    vec4 direct;
    vec4 indirect;
    vec4 caustic;
    vec4 albedo;
    vec4 hit;
    float variance;
};

// The views, by the function names in FILM_PARTS.
vec3 showBeauty(Pixel p) { return p.beauty; }
vec3 showAlbedo(Pixel p) { return p.albedo.rgb * push.share; }
vec3 showNormal(Pixel p) { return p.hit.w >= 0.0 ? 0.5 + 0.5 * p.hit.xyz : vec3(0.0); }
vec3 showDepth(Pixel p) { return vec3(p.hit.w >= 0.0 ? max(1.0 - p.hit.w / push.depth_black, 0.0) : 0.0); }
vec3 showDirect(Pixel p) { return p.direct.rgb * push.share; }
vec3 showIndirect(Pixel p) { return p.indirect.rgb * push.share; }
vec3 showCaustic(Pixel p) { return p.caustic.rgb * push.share; }
// Relative standard deviation; 10% is shown as white.
vec3 showNoise(Pixel p) { return vec3(10.0 * sqrt(p.variance) / max(luminance(p.beauty), 1e-3)); }

// A colour for each material: hues advance by the golden ratio, so that neighbours in the table differ most.
vec3 showMaterial(Pixel p) {
    if (p.hit.w < 0.0) return vec3(0.0);
    uint material = floatBitsToUint(first_hits[FIRST_HIT_VECTORS * p.number + 1u][HIT_MATERIAL]);
    float hue = float(material * 2654435769u) / 4294967296.0; // fractional part of the product with the golden ratio
    vec3 color = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(1.0), color, 0.7);
}

vec3 shownOf(Pixel pixel) {
#define NOT_SHOWN
#define SHOWN(number, NAME, label, how, function)                                                                      \
    if (push.shown == number) return function(pixel);
#define SHOW(array, Value, channels, group, nothing, source, view) view
    FILM_PARTS(SHOW)
    return pixel.beauty;
}

void main() {
    if (gl_GlobalInvocationID.x >= push.count) return;
    uint pixel = push.first + gl_GlobalInvocationID.x;
    float share = push.share, samples = push.samples;
    vec4 direct = layer(pixel, LAYER_DIRECT), indirect = layer(pixel, LAYER_INDIRECT),
         caustic = layer(pixel, LAYER_CAUSTIC), albedo = layer(pixel, LAYER_ALBEDO);
    vec3 sum = direct.rgb + indirect.rgb + caustic.rgb;
    // the moments do not include the last sample; one sample has no variance
    LuminanceMoments moments = addLuminance(LuminanceMoments(albedo.w, caustic.w), indirect.w, samples);
    float variance = samples < 2.0 ? 0.0 : varianceOfMean(moments, samples);
    vec4 hit = vec4(0.0, 0.0, 0.0, -1.0);
    if (HAS_FIRST_HITS != 0u) hit = first_hits[FIRST_HIT_VECTORS * pixel];
    // uncovered pixels show the backdrop, whose shadows need denoising too
    float alpha = direct.w > 0.0 ? direct.w * share : 1.0;
    colors[pixel] = vec4(shownOf(Pixel(pixel, sum * share, direct, indirect, caustic, albedo, hit, variance)), alpha);
    if (HAS_FIRST_HITS == 0u) return;
    surfaces[pixel] = hit.w < 0.0 ? vec4(0.0) : vec4(hit.xyz, hit.w * push.scale);
    albedos[pixel] = vec4(albedo.rgb * share, variance);
}
