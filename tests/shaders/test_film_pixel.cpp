// SPDX-License-Identifier: Apache-2.0
// The film after 65,536 samples, on the device.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shaders/film_probe.spv.h"
#include "shaders/shared/luminance_moments.h"
#include "tests/runtime/gpu/probe.h"

namespace pointrt {
namespace {

constexpr float kFilmSamples = 65536;

struct FilmAnswer {
    gpu::vec4 direct, albedo, luminance;
};

/// Film pixels of samples whose light is mean - spread and mean + spread in turn.
std::vector<FilmAnswer> accumulate(const std::vector<gpu::vec4>& lights) {
    ValidatedDevice validated;
    return answersOf<FilmAnswer>(validated.device, film_probe_spv, {filledBuffer(validated.device, lights)},
                                 lights.size(), {});
}

TEST(FilmPixel, MeansHoldAfter65536Samples) {
    const std::vector<gpu::vec4> lights = {{0.3f, 0, 0, 0},      {0.1f, 0, 0, 0},      {1.0f / 3, 0, 0, 0},
                                           {0.7f, 0.2f, 0, 0},   {1e-3f, 9e-4f, 0, 0}, {2000.1f, 0, 0, 0},
                                           {123.4f, 99.9f, 0, 0}};
    const std::vector<FilmAnswer> pixels = accumulate(lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float mean = lights[i].x, tolerance = 2e-5f * mean;
        EXPECT_NEAR(pixels[i].direct.x, mean, tolerance);
        EXPECT_NEAR(pixels[i].direct.z, mean, tolerance);
        EXPECT_NEAR(pixels[i].direct.w, 1, 2e-5);
        EXPECT_NEAR(pixels[i].albedo.y, mean, tolerance);
    }
}

TEST(FilmPixel, VarianceHoldsAfter65536Samples) {
    const std::vector<gpu::vec4> lights = {
        {0.3f, 0, 0, 0}, {2000.1f, 0, 0, 0}, {0.7f, 0.2f, 0, 0}, {0.5f, 1e-3f, 0, 0}, {123.4f, 99.9f, 0, 0}};
    const std::vector<FilmAnswer> pixels = accumulate(lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const gpu::vec4& before = pixels[i].luminance;
        const LuminanceMoments moments = addLuminance({before.x, before.y}, before.z, kFilmSamples);
        const float spread = lights[i].y, rounding = 1e-6f * lights[i].x;
        EXPECT_NEAR(moments.mean, lights[i].x, 20 * rounding);
        EXPECT_NEAR(moments.variance, spread * spread, 2e-3f * spread * spread + rounding * rounding) << lights[i].x;
    }
}

} // namespace
} // namespace pointrt
