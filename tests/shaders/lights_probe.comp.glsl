// SPDX-License-Identifier: Apache-2.0
// Evaluates lights.glsl and sampler.glsl: counts.y samples per receiver, receiver after receiver.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/lights.glsl"
#include "shaders/lib/sampler.glsl"

layout(local_size_x = 64) in;

struct Receiver {
    vec4 point; // w: dimension pair of its samples
    uvec4 light; // x: number of the light, y: pixel, z: seed
};
struct Answer {
    vec4 direction; // w: distance
    vec4 radiance_over_pdf; // w: pdf
    vec4 pdf; // x: lightPdf of direction, y: lightPdf of free, z: 1 if free hits the disc of the sun; w: sample1
    vec4 free; // a uniform direction; w: red radiance of the light
    vec4 sample2; // xy
};

layout(push_constant) uniform Push { uvec4 counts; } push; // x: answers, y: samples per receiver
layout(std430, binding = 0) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 1) readonly buffer Receivers { Receiver receivers[]; };
layout(std430, binding = 2) writeonly buffer Answers { Answer answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.counts.x) return;
    const Receiver receiver = receivers[i / push.counts.y];
    const Light light = lights[receiver.light.x];
    const uint number = i % push.counts.y, pair = uint(receiver.point.w);
    const vec2 u = sample2(receiver.light.y, number, pair, receiver.light.z);
    const LightSample to = sampleLight(light, receiver.point.xyz, u);
    const vec3 free = coneDirection(vec3(0.0, 0.0, 1.0), 2.0 * u.x, u.y);
    answers[i].direction = vec4(to.direction, to.distance);
    answers[i].radiance_over_pdf = vec4(to.radiance_over_pdf, to.pdf);
    answers[i].pdf = vec4(lightPdf(light, receiver.point.xyz, to.direction),
                          lightPdf(light, receiver.point.xyz, free), hitsSun(light, free) ? 1.0 : 0.0,
                          sample1(receiver.light.y, number, pair, receiver.light.z));
    answers[i].free = vec4(free, lightRadiance(light).x);
    answers[i].sample2 = vec4(u, 0.0, 0.0);
}
