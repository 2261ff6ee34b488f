// SPDX-License-Identifier: Apache-2.0
// Any hit: whether one instance of Gaussians hides at least half of the light along each ray of a batch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/cast/cast_rays.glsl"
#include "shaders/trace/gaussian_first_hit.glsl"
#include "shaders/trace/gaussian_transmittance.glsl"

void main() {
    uint row = castRow();
    if (row == NO_INDEX) return;
    LoadedRay loaded = loadRay(row);
    TraceRay in_cube = instanceRay(loaded.ray);
    bool enters, cut;
    GaussianRay ray = gaussianRayInCube(in_cube.origin, in_cube.direction, in_cube.t_max, enters);
    float passes = gaussianTransmittance(ray, enters, in_cube.t_max > 0.0, kHalf, cut);
    storeStopped(row, loaded, passes <= kHalf);
}
