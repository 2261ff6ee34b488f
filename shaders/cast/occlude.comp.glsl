// SPDX-License-Identifier: Apache-2.0
// Whether one instance stands in the way of a batch of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/cast/cast_rays.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    bool hits = trace(instanceRay(loadCastRay(row))).disc != NO_INDEX;
    imageStore(cast_stopped, int(row), uvec4(hits ? 1u : 0u));
}
