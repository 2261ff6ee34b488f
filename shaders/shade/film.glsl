// SPDX-License-Identifier: Apache-2.0
// Film accumulation.
#ifndef POINTRT_SHADERS_FILM_GLSL
#define POINTRT_SHADERS_FILM_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shade/film_sums.glsl"

uint filmIndex(uint path, uint layer) { return layer * params.film_pixels + params.film_first + bandPixel(path); }

// Accumulates light that was scattered this many times between its source and the pixel. Skips black, to save memory
// traffic.
void accumulateLight(uint path, vec3 light, uint scatterings) {
    if (light == vec3(0.0)) return;
    film[filmIndex(path, scatterings <= 1u ? LAYER_DIRECT : LAYER_INDIRECT)].rgb += light;
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}

// Whether paths may change LAYER_DIRECT. Light that reaches a path after more than one scattering is indirect.
bool mayAddDirect() { return kCameraPass || !kOneBounce || hasStep(STEP_DIRECT); }

// The sums of the layers from first on: 0, or FILM_LAYERS for the earlier batches. Excludes layers that only the camera
// pass or photons change.
PixelSums loadSums(uint path, uint first) {
    PixelSums sums = kNoSums;
    if (mayAddDirect()) sums.direct = film[filmIndex(path, first + LAYER_DIRECT)];
    sums.indirect = film[filmIndex(path, first + LAYER_INDIRECT)];
    if (kGathersPhotons || kCameraPass) sums.caustic = film[filmIndex(path, first + LAYER_CAUSTIC)];
    if (kCameraPass) sums.albedo = film[filmIndex(path, first + LAYER_ALBEDO)];
    return sums;
}

void storeSums(uint path, uint first, PixelSums sums) {
    if (mayAddDirect()) film[filmIndex(path, first + LAYER_DIRECT)] = sums.direct;
    film[filmIndex(path, first + LAYER_INDIRECT)] = sums.indirect;
    if (kGathersPhotons || kCameraPass) film[filmIndex(path, first + LAYER_CAUSTIC)] = sums.caustic;
    if (kCameraPass) film[filmIndex(path, first + LAYER_ALBEDO)] = sums.albedo;
}

#endif
