// SPDX-License-Identifier: Apache-2.0
// The sums of a pixel over the samples of the current batch, and over those of the earlier batches.
#ifndef POINTRT_SHADERS_FILM_SUMS_GLSL
#define POINTRT_SHADERS_FILM_SUMS_GLSL
#include "shaders/shared/luminance.h"
#include "shaders/shared/luminance_moments.h"

// The film layers of these names.
struct PixelSums {
    vec4 direct;
    vec4 indirect;
    vec4 caustic;
    vec4 albedo;
};

const PixelSums kNoSums = PixelSums(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));

void accumulateLight(inout PixelSums sums, vec3 light, uint scatterings) {
    sums.direct.rgb += scatterings <= 1u ? light : vec3(0.0);
    sums.indirect += vec4(scatterings <= 1u ? vec3(0.0) : light, luminance(light));
}

void accumulateCaustic(inout PixelSums sums, vec3 light) {
    sums.caustic.rgb += light;
    sums.indirect.w += luminance(light);
}

// Starts a sample: accumulates its coverage (1 if the scene itself is hit) and the albedo of the hit. Adds the previous
// sample to the moments of the luminance. The first sample clears the sums.
PixelSums beginSample(PixelSums sums, float covered, vec3 albedo, uint sample_index) {
    if (sample_index == 0u) sums = kNoSums;
    LuminanceMoments moments = addLuminance(LuminanceMoments(sums.albedo.w, sums.caustic.w), sums.indirect.w,
                                            max(float(sample_index), 1.0)); // for the first sample, adds only zeros
    return PixelSums(sums.direct + vec4(vec3(0.0), covered), vec4(sums.indirect.rgb, 0.0),
                     vec4(sums.caustic.rgb, moments.squares), vec4(sums.albedo.rgb + albedo, moments.mean));
}

// The last sample's luminance and the mean luminance are not sums, so they are left to the current batch.
PixelSums addBatch(PixelSums earlier, PixelSums batch) {
    return PixelSums(earlier.direct + batch.direct, vec4(earlier.indirect.rgb + batch.indirect.rgb, 0.0),
                     earlier.caustic + batch.caustic, vec4(earlier.albedo.rgb + batch.albedo.rgb, 0.0));
}

PixelSums nextBatch(PixelSums batch) {
    return PixelSums(vec4(0.0), vec4(vec3(0.0), batch.indirect.w), vec4(0.0), vec4(vec3(0.0), batch.albedo.w));
}

#endif
