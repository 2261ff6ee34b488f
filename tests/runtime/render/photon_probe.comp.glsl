// SPDX-License-Identifier: Apache-2.0
// Evaluates shaders/shade/caustic.glsl at many points of a photon map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/photon_layout.h"

layout(std430, set = 0, binding = 0) readonly buffer PhotonBuffer { vec4 photon_vectors[]; };
layout(std430, set = 0, binding = 1) readonly buffer BucketBuffer { uint photon_words[]; };
layout(std430, set = 0, binding = 2) readonly buffer FrameBuffer { CausticFrame map; };
layout(std430, set = 0, binding = 3) readonly buffer PointBuffer { vec4 points[]; }; // position, normal
layout(std430, set = 0, binding = 4) writeonly buffer AnswerBuffer { vec4 answers[]; };
#define loadPhoton(photon, member) photon_vectors[(photon) * PHOTON_VECTORS + (member)]
#define loadPhotonWord(i) photon_words[i]
#define loadPhotonLevel(i) map.levels[i]
#include "shaders/shade/caustic.glsl"

layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length()) return;
    answers[i] = vec4(causticIrradiance(true, points[2u * i].xyz, points[2u * i + 1u].xyz), 0.0);
}
