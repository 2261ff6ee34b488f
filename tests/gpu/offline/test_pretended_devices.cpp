// SPDX-License-Identifier: Apache-2.0
// A Vulkan layer (layer.cpp) makes the local device look like others. Tests that pictures equal the CPU's to the bit,
// count submissions, waits and allocations, and check that devices without the required limits are refused.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "format/base/error.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/gpu/memory_budget.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/gpu/offline/pretended.h"
#include "tests/support/says.h"
#include "tests/support/validated_device.h"
#include "tests/trace/gaussian_file.h"
#include "tests/trace/gaussian_picture.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kSide = 48;
constexpr std::uint32_t kBounces = 4;
/// For one sample of a pixel, path traced in a room: 1,200 MB for 4 samples of 512x512.
constexpr std::uint64_t kMostBytes = 1'200'000'000 / (4 * 512 * 512);

RenderSettings pathSettings() {
    RenderSettings settings = square(kSide);
    settings.integrator = Integrator::kPath;
    settings.bounces = kBounces;
    settings.room = Room::kMatte;
    settings.spp = 2;
    settings.first_hits = true;
    return settings;
}

/// Settings with which light that mirrors reflect counts as direct.
RenderSettings mirrorSettings() {
    RenderSettings settings = pathSettings();
    settings.integrator = Integrator::kWhitted;
    settings.room = Room::kMirror;
    return settings;
}

std::unique_ptr<LoadedScene> loadBall(Device& device, const SphereFile& ball,
                                      const RenderSettings& settings = pathSettings()) {
    LoadRequest request;
    request.scene.instances.push_back({ball.path, {}, {}, {}});
    request.settings = settings;
    return loadScene(device, device, request, {});
}

Film render(Device& device, const SphereFile& ball, const RenderSettings& settings = pathSettings()) {
    const std::unique_ptr<LoadedScene> loaded = loadBall(device, ball, settings);
    ProgressiveRenderer renderer(device, loaded->tracer);
    FrameJob job;
    job.samples = settings.spp;
    renderer.begin({settings, loaded->camera, tilingFor(device, kSide, kSide)}, job);
    renderer.run();
    return renderer.takeFilm();
}

Film renderOn(const std::map<std::string, std::string>& variables, const SphereFile& ball,
              const RenderSettings& settings = pathSettings()) {
    const Environment environment(variables);
    ValidatedDevice validated;
    return render(validated.device, ball, settings);
}

/// A device's type and memory as the layer pretends them.
struct Pretended {
    const char *type, *memory;
};

class PretendedDevices : public testing::Test {
protected:
    SphereFile ball{3000};
};

TEST_F(PretendedDevices, RenderTheSamePicture) {
    const Film expected = renderOn({}, ball);
    for (const Pretended& each :
         {Pretended{"discrete", "discrete"}, {"integrated", "write_combined"}, {"integrated", "incoherent"}}) {
        SCOPED_TRACE(each.memory);
        const Film film =
            renderOn(layered({{"POINTRT_LAYER_TYPE", each.type}, {"POINTRT_LAYER_MEMORY", each.memory}}), ball);
        EXPECT_EQ(film.rgba, expected.rgba);
        EXPECT_EQ(film.variance, expected.variance);
        EXPECT_EQ(film.depth, expected.depth);
    }
}

TEST_F(PretendedDevices, RenderTheSamePictureOfMirrors) {
    const Film expected = renderOn({}, ball, mirrorSettings());
    const Film film = renderOn(layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}}),
                               ball, mirrorSettings());
    EXPECT_EQ(film.rgba, expected.rgba);
    EXPECT_EQ(film.direct, expected.direct);
    EXPECT_EQ(film.indirect, expected.indirect);
}

// A submission for each sample, however many parts its rows have, and nothing allocated.
TEST_F(PretendedDevices, TraceASampleInOneSubmission) {
    const Environment environment(layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}}));
    ValidatedDevice validated;
    Device& device = validated.device;
    const std::unique_ptr<LoadedScene> loaded = loadBall(device, ball);
    const RenderSettings settings = pathSettings();
    ASSERT_TRUE(endsIn(loaded->tracer, settings, kBounces));
    std::vector<float> films[2];
    for (const std::uint32_t parts : {1u, 3u}) {
        loaded->tracer.buffers.lanes = kSide * kSide / parts;
        RayCounts rays;
        BandSample sample = openBand(loaded->tracer, settings, loaded->camera, {0, kSide}, {kSide * kSide, 0});
        waitForSubmitted(device); // of loading, which a busy machine may still be at
        const Counts counts;
        tracePasses(device, loaded->tracer, sample, kBounces, rays);
        EXPECT_TRUE(sample.done);
        EXPECT_EQ(rays.primary, kSide * kSide);
        EXPECT_EQ(counts.of("submits"), 1u);
        EXPECT_LE(counts.of("waits"), 1u);
        EXPECT_EQ(counts.of("allocations"), 0u);
        EXPECT_LE(counts.of("dispatches"), 30 * parts);
        EXPECT_LE(counts.of("barriers"), 29 * parts);
        films[parts / 2].resize(loaded->tracer.buffers.film.bytes / sizeof(float));
        downloadBuffer(device, loaded->tracer.buffers.film, films[parts / 2].data(), loaded->tracer.buffers.film.bytes);
    }
    EXPECT_EQ(films[0], films[1]);
}

// Only lavapipe cuts loops, for which there are rounds.
TEST_F(PretendedDevices, CompositeACaptureInOneDispatch) {
    const GaussianFile capture(makeGaussians("random", 200));
    std::vector<float> films[2];
    for (const bool pretends : {false, true}) {
        const Environment environment(pretends ? layered({{"POINTRT_LAYER_TYPE", "discrete"}})
                                               : std::map<std::string, std::string>{});
        ValidatedDevice validated;
        Device& device = validated.device;
        LoadRequest request;
        request.scene.instances.push_back({capture.path, {}, {}, {}});
        request.settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0}, kSide);
        const std::unique_ptr<LoadedScene> loaded = loadScene(device, device, request, {});
        PassProfile profile;
        loaded->tracer.profile = &profile;
        BandSample sample = openBand(loaded->tracer, request.settings, loaded->camera, {0, kSide}, {kSide * kSide, 0});
        RayCounts rays;
        tracePasses(device, loaded->tracer, sample, 0, rays);
        std::uint64_t composites = 0;
        for (const PassTally& pass : profile.passes)
            if (pass.name == "composite_gaussians (camera)") composites += pass.runs;
        EXPECT_EQ(composites, pretends ? 1u : 64u);
        films[pretends].resize(loaded->tracer.buffers.film.bytes / sizeof(float));
        downloadBuffer(device, loaded->tracer.buffers.film, films[pretends].data(), loaded->tracer.buffers.film.bytes);
    }
    EXPECT_EQ(films[0], films[1]);
}

/// Instead of as texels, which GPUs read more slowly.
TEST_F(PretendedDevices, ReadScansOfOnePageAsStorageBuffers) {
    const Film expected = renderOn({}, ball);
    const Environment environment(layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}}));
    for (const std::uint32_t page_bits : {31u, 12u}) {
        DeviceRequest request;
        request.page_bits_most = page_bits;
        ValidatedDevice validated(request);
        const std::unique_ptr<LoadedScene> loaded = loadBall(validated.device, ball);
        const DeviceScan& scan = *loaded->scene.files.begin();
        EXPECT_EQ(scan.reads_storage, page_bits == 31);
        EXPECT_EQ(isPaged(scan.pages), page_bits == 12);
        EXPECT_EQ(render(validated.device, ball).rgba, expected.rgba);
    }
}

// RDNA has subgroups of 64 lanes unless a program requests 32; GCN has no others, Intel and NVIDIA none larger.
TEST_F(PretendedDevices, HaveSubgroupsOf32LanesIfTheyCan) {
    const Film expected = renderOn({}, ball);
    for (const auto& [lanes, asks] : {std::pair("64", true), {"32", false}}) {
        const Counts counts;
        const Film film = renderOn(layered({{"POINTRT_LAYER_TYPE", "discrete"},
                                            {"POINTRT_LAYER_MEMORY", "discrete"},
                                            {"POINTRT_LAYER_SUBGROUPS", lanes}}),
                                   ball);
        EXPECT_EQ(film.rgba, expected.rgba);
        EXPECT_GT(counts.of("pipelines"), 0u);
        EXPECT_EQ(counts.of("pipelines_of_32"), asks ? counts.of("pipelines") : 0u) << lanes;
    }
}

/// Milliseconds and lanes of passes, without a submission for each.
TEST_F(PretendedDevices, ProfilePassesWithinASubmission) {
    const Environment environment(layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}}));
    ValidatedDevice validated;
    Device& device = validated.device;
    const std::unique_ptr<LoadedScene> loaded = loadBall(device, ball);
    PassProfile profile;
    profile.clock = createPassClock(device);
    ASSERT_NE(profile.clock.timer.pool, VK_NULL_HANDLE);
    RayCounts rays[2];
    std::vector<float> films[2];
    for (const std::size_t profiled : {0u, 1u}) {
        loaded->tracer.profile = profiled ? &profile : nullptr;
        BandSample sample = openBand(loaded->tracer, pathSettings(), loaded->camera, {0, kSide}, {kSide * kSide, 0});
        const Counts counts;
        tracePasses(device, loaded->tracer, sample, kBounces, rays[profiled]);
        EXPECT_EQ(counts.of("submits"), 1u);
        EXPECT_EQ(counts.of("labels"), counts.of("ended_labels"));
        EXPECT_GE(counts.of("labels"), counts.of("dispatches"));
        films[profiled].resize(loaded->tracer.buffers.film.bytes / sizeof(float));
        downloadBuffer(device, loaded->tracer.buffers.film, films[profiled].data(), loaded->tracer.buffers.film.bytes);
    }
    EXPECT_EQ(films[0], films[1]);
    EXPECT_EQ(rays[0].secondary, rays[1].secondary);
    std::uint64_t camera = 0, secondary = 0, bytes = 0;
    for (const PassTally& pass : profile.passes) {
        bytes += pass.bytes;
        EXPECT_GT(pass.device_ms, 0) << pass.name;
        if (pass.name == "megakernel (camera)") camera = pass.lanes_in;
        if (pass.name == "megakernel") secondary = pass.lanes_in;
    }
    EXPECT_LE(bytes, kMostBytes * rays[1].primary);
    EXPECT_EQ(camera, rays[1].primary);
    EXPECT_GT(secondary, 0u);
    EXPECT_LE(secondary, rays[1].secondary);
    destroyPassClock(device, profile.clock);
}

TEST_F(PretendedDevices, ThatAreLost_EndWithAnError) {
    for (const std::uint64_t after : {1, 4}) {
        const std::string number = std::to_string(after);
        const Environment environment(layered({{"POINTRT_LAYER_TYPE", "discrete"},
                                               {"POINTRT_LAYER_MEMORY", "discrete"},
                                               {"POINTRT_LAYER_LOST_AT", number}}));
        ValidatedDevice validated;
        try {
            render(validated.device, ball);
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kCannotRun);
            EXPECT_SAYS(error.what(), "*VK_ERROR_DEVICE_LOST*");
        }
    }
}

// Device memory that other programs use is not available for tiles.
TEST_F(PretendedDevices, LeaveTilesTheirBudget) {
    constexpr std::uint64_t kGibibyte = 1ull << 30;
    auto variables = layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}});
    {
        const Environment environment(variables);
        const ValidatedDevice validated;
        const std::uint64_t available = availableDeviceMemory(validated.device);
        EXPECT_LE(available, validated.device.memory.memoryHeaps[0].size); // less where the driver has budgets: Mesa 25
        EXPECT_GT(available, kGibibyte);
    }
    variables["POINTRT_LAYER_BUDGET"] = std::to_string(kGibibyte); // half of it is in use
    const Environment environment(variables);
    ValidatedDevice validated;
    EXPECT_EQ(availableDeviceMemory(validated.device), kGibibyte / 2);
    EXPECT_LT(tileMemory(validated.device, 4 * kGibibyte), kGibibyte / 2);
}

TEST_F(PretendedDevices, ThatLackDescriptors_AreRefused) {
    const Environment environment(layered({{"POINTRT_LAYER_LIMITS", "maxPerStageDescriptorStorageBuffers=8"}}));
    EXPECT_HAS(listDevices(), "unusable: *8 storage buffers");
    EXPECT_THROW(createDevice({}), Error);
}

} // namespace
} // namespace pointrt::test
