// SPDX-License-Identifier: Apache-2.0
// Evaluates shaders/shade/material.glsl for many directions or random numbers at one surface.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(set = 0, binding = 0) uniform samplerBuffer ggx_texels;
#define loadGgxAlbedo(i) texelFetch(ggx_texels, int(i)).xy
#include "shaders/shade/material.glsl"

layout(local_size_x = 64) in;

struct Surface {
    Material material;
    vec4 albedo; // w: 1 on the inner side
    vec4 normal;
    vec4 view; // w: 1: inputs are light directions, 0: random numbers
};

struct Answer {
    vec4 scattered;        // direction and pdf
    vec4 weight;           // w: sum of 1 transmitted, 2 isDelta, 4 hasSmoothLobe
    vec4 evaluated;        // for the input, or for the direction drawn; w: bsdfPdf
    vec4 reflected;        // w: phongHighlight
    vec4 reflected_weight; // w: highlightMirrorShare
    vec4 refracted;
    vec4 refracted_weight;
    vec4 rest;             // smoothAlbedo
    vec4 classic;          // classicBsdf for a light that rays can hit
};

layout(std430, set = 0, binding = 1) readonly buffer SurfaceBuffer { Surface surface; };
layout(std430, set = 0, binding = 2) readonly buffer InputBuffer { vec4 inputs[]; };
layout(std430, set = 0, binding = 3) writeonly buffer AnswerBuffer { Answer answers[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= inputs.length()) return;
    vec3 n = surface.normal.xyz, wo = surface.view.xyz;
    Bsdf s = materialBsdf(surface.material, surface.albedo.rgb, surface.albedo.w == 1.0, dot(n, wo));
    Scattering drawn = sampleBsdf(s, n, wo, inputs[i].xyz);
    vec3 wi = surface.view.w == 1.0 ? inputs[i].xyz : drawn.direction;
    SpecularPair pair = specularPair(s, n, wo);
    float flags = (drawn.transmitted ? 1.0 : 0.0) + (isDelta(drawn) ? 2.0 : 0.0) + (hasSmoothLobe(s) ? 4.0 : 0.0);
    answers[i] = Answer(vec4(drawn.direction, drawn.pdf), vec4(drawn.weight, flags),
                        vec4(evaluateBsdf(s, n, wo, wi), bsdfPdf(s, n, wo, wi)),
                        vec4(pair.reflected, phongHighlight(s, n, wo, wi)),
                        vec4(pair.reflected_weight, highlightMirrorShare(surface.material, dot(n, wo))),
                        vec4(pair.refracted, 0.0), vec4(pair.refracted_weight, 0.0), vec4(smoothAlbedo(s), 0.0),
                        vec4(classicBsdf(s, n, wo, wi, true), 0.0));
}
