// SPDX-License-Identifier: Apache-2.0
// Whether one instance stands in the way of a batch of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/cast/cast_rays.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    LoadedRay loaded = loadRay(row);
    storeStopped(row, loaded, trace(instanceRay(loaded.ray)).disc != NO_INDEX);
}
