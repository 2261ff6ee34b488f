// SPDX-License-Identifier: Apache-2.0
// The smallest possible program.
#version 450

layout(local_size_x = 1) in;
layout(binding = 0, std430) writeonly buffer Result { uint result; };

void main() { result = 1u; }
