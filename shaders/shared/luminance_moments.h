// SPDX-License-Identifier: Apache-2.0
// Mean and variance of luminance over the samples of a pixel, one sample at a time (Welford, "Note on a method for
// calculating corrected sums of squares and products", Technometrics 1962). Sums of squares would cancel in float.
// Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_LUMINANCE_MOMENTS_H
#define POINTRT_SHADERS_LUMINANCE_MOMENTS_H

#ifdef __cplusplus
namespace pointrt {
#endif

struct LuminanceMoments {
    float mean;
    float variance; // mean squared distance from the mean
};

#ifdef __cplusplus
inline LuminanceMoments addLuminance(LuminanceMoments before, float added, float samples);
#endif

// samples: with the added one.
LuminanceMoments addLuminance(LuminanceMoments before, float added, float samples) {
    float delta = added - before.mean;
    LuminanceMoments after;
    after.mean = before.mean + delta / samples;
    after.variance = before.variance + (delta * (added - after.mean) - before.variance) / samples;
    return after;
}

#ifdef __cplusplus
} // namespace pointrt
#endif

#endif
