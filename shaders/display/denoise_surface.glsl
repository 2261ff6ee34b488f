// SPDX-License-Identifier: Apache-2.0
// Guides of the preview denoiser: the surface of a pixel, and the distance between the surfaces of two pixels.
#ifndef POINTRT_SHADERS_DENOISE_SURFACE_GLSL
#define POINTRT_SHADERS_DENOISE_SURFACE_GLSL
#include "shaders/shared/luminance.h"

// Kinds of pixels; only pixels of the same kind are averaged. Partly covered pixels have a kind for each eighth of
// coverage, so that the background in them does not spread.
#define KIND_EMPTY 1.0
#define KIND_FULL 9.0
#define KIND_BLACK 16.0 // added if the albedo is 0: emitters and perfect mirrors

// Normals more than about 20 degrees apart hardly count: exp(-48 (1 - cos 20)) = 0.06.
const float kNormalSharpness = 48.0;
// Largest deviation from the predicted plane that counts as the same surface: this share of the predicted slope ...
const float kSlopeTolerance = 0.25;
// ... plus this many pixel widths of depth per pixel of distance, as on a surface that turns away by 45 degrees.
const float kDepthPixels = 1.0;

// Largest light: its square, and products of four such values, fit into a float.
const float kBrightest = 1e9;

struct DenoiseSurface {
    vec3 normal;
    float closeness; // 1 / depth, linear in the picture of a plane; 0: unknown
    float kind;      // KIND_*
    bool broken;     // its light is not finite
};

bool isFinite(float value) { return (floatBitsToUint(value) & 0x7F800000u) != 0x7F800000u; }
bool isFinite(vec3 v) { return isFinite(v.x) && isFinite(v.y) && isFinite(v.z); }

vec2 signs(vec2 v) { return vec2(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0); }

// Octahedral normal (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 2014),
// closeness, kind; the kind is negated for broken pixels.
vec4 packSurface(DenoiseSurface surface) {
    vec3 n = surface.normal / max(dot(abs(surface.normal), vec3(1.0)), 1e-12);
    vec2 folded = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * signs(n.xy);
    return vec4(folded, surface.closeness, surface.broken ? -surface.kind : surface.kind);
}

DenoiseSurface unpackSurface(vec4 words) {
    vec3 n = vec3(words.xy, 1.0 - abs(words.x) - abs(words.y));
    n.xy -= signs(n.xy) * max(-n.z, 0.0);
    return DenoiseSurface(n * inversesqrt(dot(n, n)), words.z, abs(words.w), words.w < 0.0);
}

bool sameKind(DenoiseSurface a, DenoiseSurface b) { return a.kind == b.kind && a.kind != KIND_EMPTY; }

// Distance between the surfaces of a and of b, offset pixels away, as the exponent x of the weight exp(-x). slope:
// change of closeness per pixel at a. pixel_angle: radians.
float surfaceDistance(DenoiseSurface a, vec2 slope, DenoiseSurface b, vec2 offset, float pixel_angle) {
    float predicted = dot(slope, offset);
    float tolerance = kSlopeTolerance * abs(predicted) +
                      kDepthPixels * pixel_angle * length(offset) * a.closeness + 1e-20;
    float off = (b.closeness - a.closeness - predicted) / tolerance;
    return kNormalSharpness * max(0.0, 1.0 - dot(a.normal, b.normal)) + off * off;
}

#endif
