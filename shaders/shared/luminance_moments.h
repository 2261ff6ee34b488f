// SPDX-License-Identifier: Apache-2.0
// Mean and spread of the luminance of a pixel's samples, one sample at a time (Welford, "Note on a method for
// calculating corrected sums of squares and products", Technometrics 1962). In floats, subtracting a squared mean from
// a mean of squares would cancel. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_LUMINANCE_MOMENTS_H
#define POINTRT_SHADERS_LUMINANCE_MOMENTS_H

#ifdef __cplusplus
#define POINTRT_SHARED_FUNCTION inline
namespace pointrt {
#else
#define POINTRT_SHARED_FUNCTION
#endif

struct LuminanceMoments {
    float mean;
    float squares; // sum of the squared distances from the mean
};

// samples: number including the added one.
POINTRT_SHARED_FUNCTION LuminanceMoments addLuminance(LuminanceMoments before, float added, float samples) {
    float change = added - before.mean;
    LuminanceMoments after;
    after.mean = before.mean + change / samples;
    after.squares = before.squares + change * (added - after.mean);
    return after;
}

// For at least two samples.
POINTRT_SHARED_FUNCTION float varianceOfMean(LuminanceMoments moments, float samples) {
    return moments.squares / (samples - 1.0f) / samples;
}

#undef POINTRT_SHARED_FUNCTION
#ifdef __cplusplus
} // namespace pointrt
#endif

#endif
