// SPDX-License-Identifier: Apache-2.0
// result[i] = words[i] * FACTOR + summand, for i below count: every kind of input that programs of the viewer have.
#version 450

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint FACTOR = 1;
layout(push_constant) uniform Push {
    uint count;
    uint summand;
    uvec2 unused;
    float also_unused[3];
} push;
layout(binding = 0) uniform usamplerBuffer words;
layout(binding = 3, std430) writeonly buffer Result { uint result[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.count) result[i] = texelFetch(words, int(i)).x * FACTOR + push.summand;
}
