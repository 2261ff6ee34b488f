// SPDX-License-Identifier: Apache-2.0
// A film is the same for any division into bands, strips and steps.
#include "runtime/render/progressive_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/gpu/device.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/pick.h"
#include "runtime/render/strip_pace.h"
#include "tests/support/ball_scene.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 33, kProgressiveSamples = 3;

LoadRequest testRequest(FormRequest form = {}) {
    LoadRequest request;
    request.scene = ballScene();
    request.settings.width = kWidth;
    request.settings.height = kHeight;
    request.settings.spp = kProgressiveSamples;
    request.settings.integrator = Integrator::kPath;
    request.settings.first_hits = true;
    request.settings.caustics = false;
    request.form = form;
    return request;
}

class ProgressiveRendererTest : public DeviceFixture {
protected:
    void SetUp() override { load({}); }

    void load(FormRequest form) {
        loaded = loadScene(device, device, testRequest(form), {});
        plan = {loaded->settings, loaded->camera, {kHeight, kHeight}};
        job.samples = kProgressiveSamples;
        whole = render(plan);
    }

    Film render(const RenderPlan& of, const Film* start = nullptr) {
        ProgressiveRenderer renderer(device, loaded->tracer);
        renderer.begin(of, job, start ? std::optional(*start) : std::nullopt);
        renderer.run();
        return renderer.takeFilm();
    }

    static void expectSame(const Film& a, const Film& b) {
        EXPECT_EQ(a.rgba, b.rgba);
        EXPECT_EQ(a.variance, b.variance);
        EXPECT_EQ(a.samples, b.samples);
        EXPECT_EQ(a.indirect, b.indirect);
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.normal, b.normal);
    }

    std::unique_ptr<LoadedScene> loaded;
    RenderPlan plan;
    FrameJob job;
    Film whole; ///< rendered as one band and one strip
};

TEST_F(ProgressiveRendererTest, DoesNotDependOnBandsAndStrips) {
    ASSERT_NE(whole.rgba[0], whole.rgba[4 * (kWidth * 20 + 20)]);
    for (const FrameTiling tiling : {FrameTiling{kHeight, 8}, FrameTiling{16, 16}, FrameTiling{8, 8}}) {
        plan.tiling = tiling;
        expectSame(render(plan), whole);
    }
}

/// A band that is continued after another one comes from the host, which stores means instead of sums: they are
/// rounded.
TEST_F(ProgressiveRendererTest, ReturnsToEarlierBands) {
    plan.tiling = {16, 16};
    job.interrupted = [] { return false; }; // called at 1 and 2 samples
    const Film film = render(plan);
    EXPECT_EQ(film.depth, whole.depth);
    EXPECT_EQ(film.samples, whole.samples);
    for (std::size_t i = 0; i < whole.rgba.size(); ++i)
        ASSERT_NEAR(film.rgba[i], whole.rgba[i], 1e-5f + 1e-5f * whole.rgba[i]) << i;
}

TEST_F(ProgressiveRendererTest, DoesNotDependOnSteps) {
    load(KernelForm::kWavefront); // the megakernel would trace all bounces at once
    ProgressiveRenderer renderer(device, loaded->tracer);
    renderer.begin(plan, job);
    int steps = 0;
    for (std::uint32_t rows = 8; renderer.openStrip(rows); rows = 40 - rows) {
        EXPECT_EQ(renderer.strip()->first_row, renderer.rowsDone());
        EXPECT_LE(renderer.strip()->sample.rows, rows);
        ++steps;
        for (int bounces = 0; !renderer.traceStrip(static_cast<std::uint32_t>(bounces)); bounces = 1) ++steps;
    }
    EXPECT_GT(steps, 12) << "steps of a few bounces each";
    EXPECT_EQ(renderer.samples(), kProgressiveSamples);
    EXPECT_EQ(renderer.takeRays().primary, std::uint64_t{kWidth} * kHeight * kProgressiveSamples);
    EXPECT_EQ(renderer.takeRays().primary, 0u);
    expectSame(renderer.takeFilm(), whole);
}

TEST_F(ProgressiveRendererTest, ContinuesAfterItsFilmIsTaken) {
    ProgressiveRenderer renderer(device, loaded->tracer);
    job.samples = 1;
    renderer.begin(plan, job);
    renderer.run();
    const Film one = renderer.takeFilm();
    EXPECT_EQ(one.samples[0], 1.0f);
    EXPECT_EQ(one.depth, whole.depth);
    EXPECT_NE(one.rgba, whole.rgba);
    renderer.setSamples(kProgressiveSamples);
    renderer.run();
    expectSame(renderer.takeFilm(), whole);
    expectSame(renderer.takeFilm(), whole);
}

TEST_F(ProgressiveRendererTest, InterruptionLeavesWholeSamples) {
    int calls = 0;
    job.interrupted = [&] { return ++calls > 3; };
    ProgressiveRenderer renderer(device, loaded->tracer);
    renderer.begin(plan, job);
    const FrameState state = renderer.run();
    EXPECT_GE(state.samples, 1u);
    EXPECT_LT(state.samples, kProgressiveSamples);
    const Film part = renderer.takeFilm();
    EXPECT_EQ(part.samples[0], static_cast<float>(state.samples));
    job.interrupted = nullptr;
    EXPECT_EQ(render(plan, &part).samples, whole.samples);
}

/// The rows of films, one after the other.
struct TakenRows {
    std::vector<float> rgba, samples, depth;

    void take(const Film& rows) {
        rgba.insert(rgba.end(), rows.rgba.begin(), rows.rgba.end());
        samples.insert(samples.end(), rows.samples.begin(), rows.samples.end());
        depth.insert(depth.end(), rows.depth.begin(), rows.depth.end());
    }
};

TEST_F(ProgressiveRendererTest, DeliversRowsOfCompletedBands) {
    TakenRows taken;
    plan.tiling = {16, 8};
    job.band_by_band = true;
    job.interrupted = [] { return false; };
    job.take_rows = [&](const Film& rows) {
        EXPECT_LE(rows.height, 16u);
        taken.take(rows);
    };
    ProgressiveRenderer renderer(device, loaded->tracer);
    renderer.begin(plan, job);
    EXPECT_EQ(renderer.run().empty_rows, 0u);
    EXPECT_EQ(taken.rgba, whole.rgba);
    EXPECT_EQ(taken.samples, whole.samples);
    EXPECT_EQ(taken.depth, whole.depth);
    job.limits.noise = 0.1;
    EXPECT_THROW(renderer.begin(plan, job), std::logic_error) << "a noise limit returns to bands";
}

/// Interrupted in the second sample of the second of three bands.
TEST_F(ProgressiveRendererTest, StopsBetweenStrips) {
    TakenRows taken;
    int strips = 0;
    plan.tiling = {16, 8};
    job.band_by_band = true;
    job.progress = [&](const FrameState&, double) { ++strips; };
    job.interrupted = [&] { return strips == 2 * 3 + 3; };
    job.take_rows = [&](const Film& rows) { taken.take(rows); };
    ProgressiveRenderer renderer(device, loaded->tracer);
    renderer.begin(plan, job);
    const FrameState state = renderer.run();
    EXPECT_EQ(state.samples, 0u);
    EXPECT_EQ(state.empty_rows, 1u) << "the last of 33";
    ASSERT_EQ(taken.samples.size(), std::size_t{32} * kWidth);
    EXPECT_EQ(taken.samples[0], 3.0f);
    EXPECT_EQ(taken.samples[23 * kWidth], 2.0f);
    EXPECT_EQ(taken.samples[24 * kWidth], 1.0f);
}

TEST_F(ProgressiveRendererTest, ContinuesWhereItStopped) {
    int strips = 0;
    plan.tiling = {kHeight, 8};
    job.progress = [&](const FrameState&, double) { ++strips; };
    for (const int last : {2, 7}) {
        strips = 0;
        job.interrupted = [&] { return strips == last; };
        const Film part = render(plan);
        EXPECT_EQ(part.samples.front(), last == 2 ? 1.0f : 2.0f);
        EXPECT_EQ(part.samples.back(), last == 2 ? 0.0f : 1.0f);
        job.interrupted = nullptr;
        const Film film = render(plan, &part);
        EXPECT_EQ(film.samples, whole.samples);
        EXPECT_EQ(film.depth, whole.depth);
        for (std::size_t i = 0; i < whole.rgba.size(); ++i)
            ASSERT_NEAR(film.rgba[i], whole.rgba[i], 1e-5f + 1e-5f * whole.rgba[i]) << i;
    }
}

TEST_F(ProgressiveRendererTest, HasAnEmptyFilmIfNothingWasTraced) {
    job.interrupted = [] { return true; };
    const Film film = render(plan);
    EXPECT_EQ(film.width, kWidth);
    EXPECT_EQ(film.rgba, std::vector<float>(whole.rgba.size(), 0.0f));
}

TEST_F(ProgressiveRendererTest, StopsAtTheNoiseLimit) {
    job.samples = 1000;
    job.limits.noise = 10; // any film is less noisy
    plan.tiling = {16, 16};
    ProgressiveRenderer renderer(device, loaded->tracer);
    renderer.begin(plan, job);
    const FrameState state = renderer.run();
    EXPECT_EQ(state.samples, 8u) << "the first check";
    ASSERT_TRUE(state.noise);
    EXPECT_EQ(*state.noise, relativeNoise(renderer.takeFilm()));
}

TEST_F(ProgressiveRendererTest, PreviewsAreLitDifferently) {
    plan.preview = true;
    job.samples = 1;
    const Film preview = render(plan);
    EXPECT_EQ(preview.depth, whole.depth);
    EXPECT_NE(preview.rgba, whole.rgba);
}

TEST_F(ProgressiveRendererTest, PicksMatchTheFilm) {
    int found = 0;
    for (std::uint32_t y = 1; y < kHeight; y += 3)
        for (std::uint32_t x = 2; x < kWidth; x += 3) {
            const std::optional<Pick> pick = pickPixel(device, loaded->tracer, plan.settings, plan.camera, x, y);
            const std::size_t at = std::size_t{y} * kWidth + x;
            ASSERT_EQ(pick.has_value(), whole.instance_id[at] != NO_INDEX);
            if (!pick) continue;
            ++found;
            EXPECT_FLOAT_EQ(static_cast<float>(pick->distance), whole.depth[at]);
            EXPECT_EQ(pick->owner, whole.instance_id[at]);
        }
    EXPECT_GT(found, 3);
}

/// Samples 0 to 7 use the first photon map for caustics, 8 to 15 the second, and 16 and 17 the third.
class RendererWithPhotonMaps : public DeviceFixture {
protected:
    static constexpr std::uint32_t kSpp = 18;

    void SetUp() override {
        LoadRequest request = testRequest();
        request.settings.width = 256;
        request.settings.height = 144;
        request.settings.spp = kSpp;
        request.settings.bounces = 1;
        request.settings.integrator = Integrator::kWhitted;
        request.settings.caustics = true;
        loaded = loadScene(device, device, request, {});
        plan = {loaded->settings, loaded->camera, {144, 144}};
    }

    Film render(std::uint32_t samples, std::optional<Film> start = {}) {
        ProgressiveRenderer renderer(device, loaded->tracer);
        FrameJob job;
        job.samples = samples;
        renderer.begin(plan, job, std::move(start));
        renderer.run();
        return renderer.takeFilm();
    }

    /// Each piece continues the film of the one before, as --resume does.
    Film renderInPieces(std::initializer_list<std::uint32_t> pieces) {
        std::optional<Film> film;
        for (const std::uint32_t samples : pieces) film = render(samples, std::move(film));
        return std::move(*film);
    }

    /// In slices, as windows render. Also returns the number of slices that traced photons.
    std::pair<Film, int> renderInSlices() {
        ProgressiveRenderer renderer(device, loaded->tracer);
        FrameJob job;
        job.samples = kSpp;
        renderer.begin(plan, job);
        int slices = 0;
        do
            while (!renderer.preparePhotons()) ++slices;
        while (renderer.samples() < kSpp && renderer.openStrip(144) && renderer.traceStrip(20));
        return {renderer.takeFilm(), slices};
    }

    static double difference(const std::vector<float>& a, const std::vector<float>& b) {
        double largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) largest = std::max<double>(largest, std::abs(a[i] - b[i]));
        return largest;
    }

    std::unique_ptr<LoadedScene> loaded;
    RenderPlan plan;
};

TEST_F(RendererWithPhotonMaps, DoesNotDependOnBandsSlicesAndResumes) {
    const Film whole = render(kSpp);
    EXPECT_EQ(loaded->tracer.caustics.later_number, 2u);
    plan.tiling = {80, 80};
    EXPECT_EQ(render(kSpp).caustic, whole.caustic) << "each band uses the first map to the last";
    plan.tiling = {144, 144};
    const auto [sliced, slices] = renderInSlices();
    EXPECT_EQ(sliced.caustic, whole.caustic);
    EXPECT_GT(slices, 2 * 8) << "slices of some milliseconds each";
    const Film pieces = renderInPieces({4, 8, 16, kSpp}); // numbers of samples whose means are exact
    EXPECT_EQ(pieces.samples, whole.samples);
    EXPECT_EQ(pieces.caustic, whole.caustic);
    // later maps make a difference
    EXPECT_GT(difference(render(8).caustic, whole.caustic), 1e-3);
}

TEST_F(RendererWithPhotonMaps, StopsWhileTracingPhotons) {
    ProgressiveRenderer renderer(device, loaded->tracer);
    FrameJob job;
    job.samples = kSpp;
    job.interrupted = [&] { return loaded->tracer.caustics.job != nullptr; };
    renderer.begin(plan, job);
    EXPECT_EQ(renderer.run().samples, 8u);
    EXPECT_EQ(renderer.takeFilm().samples[0], 8.0f);
    dropPhotons(loaded->tracer);
    rebind(device, loaded->tracer);
    EXPECT_EQ(render(9).caustic, std::vector<float>(std::size_t{3} * 256 * 144, 0.0f))
        << "dropped photons leave no caustics, of later maps either";
}

using LoadScene = DeviceFixture;

TEST_F(LoadScene, ReportsItsStagesAndCanBeCancelled) {
    struct Enough {};
    std::vector<std::string> stages;
    double before = 0;
    const LoadStage stage = [&](const char* what, double share) {
        stages.push_back(what);
        EXPECT_TRUE(share >= before || stages.size() == 4) << "the fourth stage is the first of the second load";
        before = share;
        if (stages.size() == 5) throw Enough{};
    };
    EXPECT_NE(loadScene(device, device, testRequest(), stage), nullptr);
    EXPECT_EQ(stages, (std::vector<std::string>{"reading", "materials and lights", "programs"}));
    EXPECT_THROW(loadScene(device, device, testRequest(), stage), Enough);
}

constexpr VkPhysicalDeviceType kCpu = VK_PHYSICAL_DEVICE_TYPE_CPU, kGpu = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;

TEST(StripPace, UsualScansUseTheLargestStrips) {
    EXPECT_EQ(StripPace(40, kCpu).rowsFor(512, 512), 512u);
    EXPECT_EQ(StripPace(0, kCpu).rowsFor(16384, 16), 16u);
    StripPace pace(40, kCpu);
    pace.update(512 * 512, 0.8);
    EXPECT_EQ(pace.rowsFor(512, 512), 512u);
}

TEST(StripPace, SlowScenesUseFewRows) {
    StripPace crowded(7000, kCpu);
    EXPECT_EQ(crowded.rowsFor(512, 512), 5u);
    EXPECT_EQ(crowded.rowsFor(16384, 16), 1u);
    crowded.update(512 * 5, 1e-4);
    EXPECT_EQ(crowded.rowsFor(512, 512), 5u) << "a fast strip may have been empty, and the next one crowded";
    StripPace slow(20, kCpu);
    slow.update(512 * 512, 10);
    EXPECT_EQ(slow.rowsFor(512, 512), 51u) << "about a second";
    slow.update(512 * 51, 0.01);
    EXPECT_GT(slow.rowsFor(512, 512), 51u);
}

TEST(StripPace, GpusAreFreeForTheDesktopTwentyFiveTimesASecond) {
    StripPace pace(40, kGpu);
    EXPECT_EQ(pace.rowsFor(512, 512), 512u) << "the first strip is as large as on a CPU";
    pace.update(512 * 512, 0.4);
    EXPECT_EQ(pace.rowsFor(512, 512), 51u);
    EXPECT_LT(StripPace(7000, kGpu).rowsFor(512, 512), 8u);
}

TEST(FrameTiling, StripsEndAtTiles) {
    EXPECT_EQ(stripRows(0, 512, 33), 33u);
    EXPECT_EQ(stripRows(0, 21, 33), 16u);
    EXPECT_EQ(stripRows(16, 21, 33), 17u) << "includes the partial tile at the band's end";
    EXPECT_EQ(stripRows(0, 5, 33), 5u);
    EXPECT_EQ(stripRows(5, 48, 33), 3u) << "up to the tile's end";
    EXPECT_EQ(stripRows(5, 2, 33), 2u);
    EXPECT_EQ(stripRows(32, 5, 33), 1u);
}

TEST(FrameTiling, KeepsBandsWithinTheirBuffers) {
    Device device;
    device.type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    EXPECT_EQ(tilingFor(device, 512, 512).band_rows, 512u);
    EXPECT_EQ(tilingFor(device, 1024, 1024).band_rows, 512u);
    EXPECT_EQ(tilingFor(device, 16384, 16384).strip_rows, 32u);
    device.type = VK_PHYSICAL_DEVICE_TYPE_CPU;
    EXPECT_EQ(tilingFor(device, 1024, 1024).strip_rows, 256u);
    EXPECT_EQ(tilingFor(device, 1000, 100).strip_rows, 100u);
    EXPECT_EQ(tracerSizeFor({512, 256}, 1024).film_pixels, 512u * 1024);
    EXPECT_EQ(tracerSizeFor({512, 256}, 1024).lanes, 256u * 1024);
}

} // namespace
} // namespace pointrt
