// SPDX-License-Identifier: Apache-2.0
// Films of several batches of samples: what is accumulated, resumed and refined equals the samples added up one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/render/film_readout.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "shaders/shared/luminance.h"
#include "tests/support/ball_scene.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kBatchesSide = 8, kBatchesSamples = 550; ///< three batches, the last of which is not complete
constexpr double kBatchesTolerance = 2e-5; ///< relative: a batch keeps 16 bits of each of its samples

class FilmBatches : public DeviceFixture, public testing::WithParamInterface<KernelForm> {
protected:
    void SetUp() override {
        LoadRequest request;
        request.scene = ballScene();
        request.settings.width = request.settings.height = kBatchesSide;
        request.settings.spp = kBatchesSamples;
        request.settings.integrator = Integrator::kPath;
        request.settings.caustics = false; // their maps have one form only
        request.form = GetParam();
        loaded = loadScene(device, device, request, {});
    }

    Film render(std::uint32_t samples, std::optional<Film> start = {}) {
        ProgressiveRenderer renderer(device, loaded->tracer);
        FrameJob job;
        job.samples = samples;
        renderer.begin({loaded->settings, loaded->camera, {kBatchesSide, kBatchesSide}}, job, std::move(start));
        EXPECT_EQ(renderer.run().samples, samples);
        return renderer.takeFilm();
    }

    /// The light of one sample: what it adds to a film of the earlier samples that is otherwise black.
    std::vector<double> lightOf(std::uint32_t sample) {
        Film black;
        allocateFilm(loaded->settings, black);
        std::fill(black.samples.begin(), black.samples.end(), static_cast<float>(sample));
        const Film film = render(sample + 1, sample > 0 ? std::optional(std::move(black)) : std::nullopt);
        std::vector<double> light(film.rgba.begin(), film.rgba.end());
        for (double& each : light) each *= sample + 1;
        return light;
    }

    std::unique_ptr<LoadedScene> loaded;
};

/// Largest relative difference, in terms of the larger of the two values, or of 1e-3.
double relativeDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double worst = a.size() == b.size() ? 0 : HUGE_VAL;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        worst = std::max(worst, std::abs(double{a[i]} - b[i]) / std::max({std::abs(a[i]), std::abs(b[i]), 1e-3f}));
    return worst;
}

TEST_P(FilmBatches, AddUpTheirSamples) {
    const Film film = render(kBatchesSamples);
    std::vector<double> sums(film.rgba.size()), luminances(film.variance.size()), squares(film.variance.size());
    for (std::uint32_t sample = 0; sample < kBatchesSamples; ++sample) {
        const std::vector<double> light = lightOf(sample);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += light[i];
        for (std::size_t i = 0; i < squares.size(); ++i) {
            const double each = luminance(light[4 * i], light[4 * i + 1], light[4 * i + 2]);
            luminances[i] += each;
            squares[i] += each * each;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_NEAR(film.rgba[i], sums[i] / kBatchesSamples, kBatchesTolerance * sums[i] / kBatchesSamples + 1e-7) << i;
    double noisiest = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const double mean = luminances[i] / kBatchesSamples, variance = squares[i] / kBatchesSamples - mean * mean;
        EXPECT_NEAR(film.variance[i], variance / (kBatchesSamples - 1), 1e-4 * variance / kBatchesSamples + 1e-12) << i;
        noisiest = std::max(noisiest, variance);
    }
    EXPECT_GT(noisiest, 1e-4) << "else there is nothing to measure";
}

TEST_P(FilmBatches, GoOnFromAnyNumberOfSamples) {
    const Film whole = render(kBatchesSamples);
    for (const std::uint32_t first : {FILM_BATCH - 1, FILM_BATCH, 2 * FILM_BATCH}) {
        const Film film = render(kBatchesSamples, render(first));
        EXPECT_LT(relativeDifference(film.rgba, whole.rgba), kBatchesTolerance) << first;
        EXPECT_LT(relativeDifference(film.direct, whole.direct), kBatchesTolerance) << first;
        EXPECT_LT(relativeDifference(film.indirect, whole.indirect), kBatchesTolerance) << first;
        EXPECT_LT(relativeDifference(film.albedo, whole.albedo), kBatchesTolerance) << first;
        for (std::size_t i = 0; i < film.variance.size(); ++i)
            EXPECT_NEAR(film.variance[i], whole.variance[i], 1e-4f * whole.variance[i] + 1e-12f) << first;
    }
    EXPECT_GT(relativeDifference(render(FILM_BATCH).rgba, whole.rgba), 1e-3) << "later batches count";
}

/// Reading a film between two samples does not change it on the device.
TEST_P(FilmBatches, GoOnAfterTheyAreRead) {
    ProgressiveRenderer renderer(device, loaded->tracer);
    FrameJob job;
    renderer.begin({loaded->settings, loaded->camera, {kBatchesSide, kBatchesSide}}, job);
    std::vector<Film> films;
    const std::vector<std::uint32_t> counts = {FILM_BATCH + 1, kBatchesSamples};
    for (const std::uint32_t samples : counts) {
        renderer.setSamples(samples);
        renderer.run();
        films.push_back(renderer.takeFilm());
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const Film film = render(counts[i]);
        EXPECT_EQ(films[i].rgba, film.rgba) << counts[i];
        EXPECT_EQ(films[i].variance, film.variance) << counts[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, FilmBatches, testing::Values(KernelForm::kWavefront, KernelForm::kMegakernel));

/// A film of one batch takes the memory of one, and keeps its content when it is extended.
TEST(FilmRoom, IsExtendedWithItsSums) {
    ValidatedDevice validated;
    Device& device = validated.device;
    FrameBuffers buffers = createFrameBuffers(device, TILE_PIXELS, {100, FILM_BATCH}, false, GaussianRoom::kNone);
    EXPECT_EQ(buffers.film.bytes, 100 * FILM_LAYERS * sizeof(gpu::vec4));
    std::vector<float> sums(buffers.film.bytes / sizeof(float));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = static_cast<float>(i);
    uploadBuffer(device, buffers.film, sums.data(), buffers.film.bytes);
    EXPECT_FALSE(extendFilm(device, buffers, FILM_BATCH));
    const std::uint64_t bytes = buffers.device_bytes;
    EXPECT_TRUE(extendFilm(device, buffers, FILM_BATCH + 1));
    EXPECT_EQ(buffers.film.bytes, 2 * 100 * FILM_LAYERS * sizeof(gpu::vec4));
    EXPECT_EQ(buffers.device_bytes - bytes, 100 * FILM_LAYERS * sizeof(gpu::vec4));
    std::vector<float> extended(sums.size());
    downloadBuffer(device, buffers.film, extended.data(), extended.size() * sizeof(float));
    EXPECT_EQ(extended, sums);
    EXPECT_FALSE(extendFilm(device, buffers, 1)) << "films do not shrink";
    destroyFrameBuffers(device, buffers);
}

} // namespace
} // namespace pointrt
