// SPDX-License-Identifier: Apache-2.0
// Any hit: whether one instance occludes each ray of a batch.
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
