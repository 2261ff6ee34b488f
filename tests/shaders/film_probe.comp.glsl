// SPDX-License-Identifier: Apache-2.0
// Accumulates 65,536 samples in shaders/shade/film_pixel.glsl, whose light alternates between two values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film_pixel.glsl"

layout(local_size_x = 64) in;

struct Answer {
    vec4 direct;
    vec4 albedo;
    vec4 luminance; // mean, variance, the last sample
};

layout(std430, set = 0, binding = 0) readonly buffer LightBuffer { vec4 lights[]; }; // mean, and distance from it
layout(std430, set = 0, binding = 1) writeonly buffer AnswerBuffer { Answer answers[]; };

void addSample(inout FilmPixel pixel, vec4 light, uint sample_index) {
    pixel = beginSample(pixel, 1.0, vec3(light.x), sample_index);
    float side = (sample_index & 1u) != 0u ? 1.0 : -1.0;
    accumulateLight(pixel, vec3(light.x + side * light.y), 0u, sample_index);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= lights.length()) return;
    FilmPixel pixel = FilmPixel(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    // four at a time: lavapipe silently ends loops after 65,535 iterations
    for (uint first = 0u; first < 65536u; first += 4u) {
        addSample(pixel, lights[i], first);
        addSample(pixel, lights[i], first + 1u);
        addSample(pixel, lights[i], first + 2u);
        addSample(pixel, lights[i], first + 3u);
    }
    answers[i] = Answer(pixel.direct, pixel.albedo, vec4(pixel.albedo.w, pixel.caustic.w, pixel.indirect.w, 0.0));
}
