// SPDX-License-Identifier: Apache-2.0
// Camera rays of one sample: fills queue 0 in tiles of 4x2 pixels, which lavapipe's 8 lanes then share.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "random.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// R2 sequence (Roberts 2018): steps of 1/p and 1/p^2 for the plastic number p in units of 2^-32, so that late samples
// lose no bits; shifted per pixel.
vec2 samplePosition(uint pixel) {
    if (hasStep(STEP_CENTER)) return vec2(0.5);
    uvec2 steps = push.step.x * uvec2(0xC13FA9A9u, 0x91E10DA6u);
    return fract(random3(pixel, 0u, 0u).xy + vec2(steps >> 8u) * (1.0 / 16777216.0));
}

void main() {
    uint lane = gl_GlobalInvocationID.x;
    if (lane >= bandLanes()) return;
    uint tile = lane >> 3;
    uvec2 pixel = uvec2(tile % tilesAcross() * 4u + (lane & 3u), tile / tilesAcross() * 2u + (lane >> 2 & 1u));
    if (pixel.x >= params.image.x || pixel.y >= params.image.w) {
        queues[lane] = NO_INDEX;
        return;
    }
    uint index = pixel.y * params.image.x + pixel.x;
    queues[lane] = index;
    vec2 image_size = vec2(params.image.xy);
    uvec2 image_pixel = uvec2(pixel.x, pixel.y + params.image.z);
    vec2 at = (vec2(image_pixel) + samplePosition(image_pixel.y * params.image.x + image_pixel.x)) / image_size;
    vec2 plane = vec2(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y) * params.eye.w * vec2(params.right.w, 1.0);
    vec3 direction = normalize(params.forward.xyz + plane.x * params.right.xyz + plane.y * params.up.xyz);
    paths[index] = PathState(vec4(params.eye.xyz, 0.0), vec4(direction, 0.0), vec4(1.0), vec4(0.0));
    if (push.step.x == 0u && !hasStep(STEP_FIRST_HIT)) film[index] = vec4(0.0);
}
