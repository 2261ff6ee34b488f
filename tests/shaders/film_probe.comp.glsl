// SPDX-License-Identifier: Apache-2.0
// Accumulates samples by shaders/shade/film_sums.glsl, and ends batches as fold_film.comp.glsl does.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/params.h"
#include "shaders/shade/film_sums.glsl"

layout(local_size_x = 64) in;

struct Lights {
    float even; // of every other sample
    float odd;  // of those between
    float more; // of every sample, accumulated by itself
    uint samples; // a multiple of 4
};

struct Answer {
    vec4 sum;     // of the direct light; w: coverage
    vec4 albedo;  // sum
    vec4 moments; // mean, squares, the last luminance
};

layout(std430, set = 0, binding = 0) readonly buffer LightBuffer { Lights lights[]; };
layout(std430, set = 0, binding = 1) writeonly buffer AnswerBuffer { Answer answers[]; };

void addSample(inout PixelSums batch, inout PixelSums earlier, Lights light, uint sample_index) {
    if (sample_index > 0u && sample_index % FILM_BATCH == 0u) {
        earlier = addBatch(earlier, batch);
        batch = nextBatch(batch);
    }
    batch = beginSample(batch, 1.0, vec3(light.even), sample_index);
    accumulateLight(batch, vec3((sample_index & 1u) == 0u ? light.even : light.odd), 0u);
    accumulateLight(batch, vec3(light.more), 1u);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= lights.length()) return;
    PixelSums batch = kNoSums, earlier = kNoSums;
    // four at a time: lavapipe silently ends loops after 65,535 iterations
    for (uint first = 0u; first < lights[i].samples; first += 4u)
        for (uint next = 0u; next < 4u; next++) addSample(batch, earlier, lights[i], first + next);
    PixelSums all = addBatch(earlier, batch);
    answers[i] = Answer(all.direct, all.albedo, vec4(batch.albedo.w, all.caustic.w, batch.indirect.w, 0.0));
}
