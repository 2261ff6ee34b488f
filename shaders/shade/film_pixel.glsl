// SPDX-License-Identifier: Apache-2.0
// A pixel of the film: running means over its samples. Sums would keep 8 bits of each of 65,536 samples.
#ifndef POINTRT_SHADERS_FILM_PIXEL_GLSL
#define POINTRT_SHADERS_FILM_PIXEL_GLSL
#include "shaders/shared/luminance.h"
#include "shaders/shared/luminance_moments.h"

// The film layers of these names, in registers. A program loads and stores those that it may change.
struct FilmPixel {
    vec4 direct;
    vec4 indirect;
    vec4 caustic;
    vec4 albedo;
};

// Weight of a sample in the means, once it is among them.
float sampleShare(uint sample_index) { return 1.0 / float(sample_index + 1u); }

// Accumulates light that was scattered this many times on its way from its source to the pixel.
void accumulateLight(inout FilmPixel pixel, vec3 light, uint scatterings, uint sample_index) {
    vec3 share = light * sampleShare(sample_index);
    pixel.direct.rgb += scatterings <= 1u ? share : vec3(0.0);
    pixel.indirect += vec4(scatterings <= 1u ? vec3(0.0) : share, luminance(light));
}

void accumulateCaustic(inout FilmPixel pixel, vec3 light, uint sample_index) {
    pixel.caustic.rgb += light * sampleShare(sample_index);
    pixel.indirect.w += luminance(light);
}

// Starts a sample with its coverage (1 if the scene itself is hit) and the albedo of the hit. The mean and variance of
// luminance take in the sample before. The first sample clears the pixel.
FilmPixel beginSample(FilmPixel before, float covered, vec3 albedo, uint sample_index) {
    if (sample_index == 0u) return FilmPixel(vec4(vec3(0.0), covered), vec4(0.0), vec4(0.0), vec4(albedo, 0.0));
    float share = sampleShare(sample_index);
    LuminanceMoments moments = addLuminance(LuminanceMoments(before.albedo.w, before.caustic.w), before.indirect.w,
                                            float(sample_index));
    // not before * (1 - share): the rounding of 1 - share adds up to 5e-5
    return FilmPixel(before.direct - before.direct * share + vec4(vec3(0.0), covered * share),
                     vec4(before.indirect.rgb - before.indirect.rgb * share, 0.0),
                     vec4(before.caustic.rgb - before.caustic.rgb * share, moments.variance),
                     vec4(before.albedo.rgb - before.albedo.rgb * share + albedo * share, moments.mean));
}

#endif
