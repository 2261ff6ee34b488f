// SPDX-License-Identifier: Apache-2.0
// The film after 65,536 samples, on the device.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/scene/render_settings.h"
#include "shaders/film_probe.spv.h"
#include "shaders/shared/luminance_moments.h"
#include "shaders/shared/vectors.h"
#include "tests/runtime/gpu/probe.h"

namespace pointrt {
namespace {

/// Input and output of the probe shader (film_probe.comp.glsl).
struct ProbeLights {
    float even, odd, more;
    std::uint32_t samples = kMaxSpp;
};
struct FilmSumsAnswer {
    gpu::vec4 sum, albedo, moments;
};

std::vector<FilmSumsAnswer> sumOnDevice(const std::vector<ProbeLights>& lights) {
    ValidatedDevice validated;
    return answersOf<FilmSumsAnswer>(validated.device, film_probe_spv, {filledBuffer(validated.device, lights)},
                                     lights.size(), {});
}

double meanLight(const ProbeLights& light) { return (double{light.even} + light.odd) / 2 + light.more; }

/// Dim light beside bright light is what a single sum of all samples would lose.
const std::vector<ProbeLights> kProbeLights = {
    {0.3f, 0.3f, 0},       {0.1f, 0.1f, 0},         {0.7f, 0.2f, 0},        {1e-4f, 1.9e-3f, 0}, {123.4f, 23.5f, 0},
    {1, 1, 0.001f},        {1.9f, 1.9f, 0.0017f},   {1.5f, 0.1f, 0.004f},   {3e4f, 0.2f, 0.1f},  {0.8f, 0.801f, 0.02f},
    {0.3f, 0.4f, 0.1f, 4}, {0.3f, 0.4f, 0.1f, 256}, {0.3f, 0.4f, 0.1f, 260}};

TEST(FilmSums, MeansHoldAfter65536Samples) {
    const std::vector<FilmSumsAnswer> pixels = sumOnDevice(kProbeLights);
    for (std::size_t i = 0; i < kProbeLights.size(); ++i) {
        const double samples = kProbeLights[i].samples, mean = meanLight(kProbeLights[i]);
        EXPECT_NEAR(pixels[i].sum.x / samples, mean, 1e-5 * mean) << i;
        EXPECT_NEAR(pixels[i].sum.z / samples, mean, 1e-5 * mean) << i;
        EXPECT_EQ(pixels[i].sum.w, static_cast<float>(samples)) << i;
        EXPECT_NEAR(pixels[i].albedo.y / samples, kProbeLights[i].even, 1e-5 * kProbeLights[i].even) << i;
    }
}

TEST(FilmSums, VarianceHoldsAfter65536Samples) {
    const std::vector<FilmSumsAnswer> pixels = sumOnDevice(kProbeLights);
    for (std::size_t i = 0; i < kProbeLights.size(); ++i) {
        const auto samples = static_cast<float>(kProbeLights[i].samples);
        const gpu::vec4& before = pixels[i].moments;
        const LuminanceMoments moments = addLuminance({before.x, before.y}, before.z, samples);
        const double mean = meanLight(kProbeLights[i]),
                     variance = std::pow(kProbeLights[i].even - kProbeLights[i].odd, 2) / 4;
        EXPECT_NEAR(moments.mean, mean, 1e-5 * mean) << i;
        EXPECT_NEAR(varianceOfMean(moments, samples) * (samples - 1), variance, 1e-3 * variance) << i;
    }
}

} // namespace
} // namespace pointrt
