// SPDX-License-Identifier: Apache-2.0
// For each query, samples a direction with the query's xy, or evaluates the direction xyz if `drawn` is 0. Two vectors
// each.
#version 450

#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/environment_layout.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    EnvironmentFrame environment;
    uint count;
    uint drawn;
    uvec2 unused;
}
push;
layout(binding = 0) uniform samplerBuffer texels;
layout(binding = 1) uniform samplerBuffer cdf;
layout(binding = 2) uniform samplerBuffer queries;
layout(binding = 3, std430) writeonly buffer Answers { vec4 answers[]; };

#define loadEnvironmentTexel(i) texelFetch(texels, i)
#define loadEnvironmentCdf(i) texelFetch(cdf, i).x
#include "shaders/shade/environment.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec3 direction = texelFetch(queries, int(i)).xyz, radiance;
    float pdf = 0.0;
    if (push.drawn != 0u)
        radiance = sampleEnvironment(push.environment, direction.xy, direction, pdf);
    else
        radiance = environmentRadiance(push.environment, direction);
    answers[2u * i] = vec4(direction, pdf);
    answers[2u * i + 1u] = vec4(radiance, environmentPdf(push.environment, direction));
}
