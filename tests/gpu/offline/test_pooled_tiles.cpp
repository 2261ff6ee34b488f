// SPDX-License-Identifier: Apache-2.0
// GPUs trace the tiles of a set together. Pictures equal the CPU's, which traces each tile by itself, to the bit, and
// samples take as many dispatches as those of one file.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/gpu/texel_pool.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/render/tile_feedback.h"
#include "tests/gpu/offline/pretended.h"
#include "tests/support/hand_cut_set.h"
#include "tests/support/validated_device.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kPooledSide = 48;
constexpr std::size_t kTiles = 8;

std::map<std::string, std::string> discrete() {
    return layered({{"POINTRT_LAYER_TYPE", "discrete"}, {"POINTRT_LAYER_MEMORY", "discrete"}});
}

/// A picture, and how its instances were traced.
struct PooledPicture {
    Film film;
    std::size_t traced = 0; ///< instances, or tiles traced together
    std::size_t blocks = 0; ///< of the device's texel pool
    std::vector<bool> hit;  ///< marked tiles of the first set
};

PooledPicture renderOn(Device& device, const LoadRequest& request) {
    const std::unique_ptr<LoadedScene> loaded = loadScene(device, device, request, {});
    PooledPicture picture;
    picture.traced = loaded->tracer.instances.each.size();
    picture.blocks = device.texel_pool->size();
    ProgressiveRenderer renderer(device, loaded->tracer);
    FrameJob job;
    job.samples = request.settings.spp;
    renderer.begin({request.settings, loaded->camera, tilingFor(device, kPooledSide, kPooledSide)}, job);
    renderer.run();
    picture.film = renderer.takeFilm();
    markTilesHit(device, loaded->tracer, loaded->scene, request.settings, {loaded->camera});
    picture.hit = loaded->scene.sets[0].opened.hit_unseen;
    return picture;
}

/// Two devices for all tests, as building programs takes longer than the pictures.
struct BothDevices {
    ValidatedDevice cpu;
    Environment environment{discrete()};
    ValidatedDevice gpu;
};
std::unique_ptr<BothDevices> both_devices;

class PooledTiles : public testing::Test {
protected:
    static void SetUpTestSuite() { both_devices = std::make_unique<BothDevices>(); }
    static void TearDownTestSuite() { both_devices.reset(); }
    static ValidatedDevice& cpu() { return both_devices->cpu; }
    static ValidatedDevice& gpu() { return both_devices->gpu; }

    explicit PooledTiles(bool balls = false) {
        Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1);
        if (balls) makeBalls(splats);
        const TileSet set =
            writeHandCutSet(folder, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, splats.radii[0]}, splats, splats);
        EXPECT_EQ(set.tiles.size(), kTiles + 1); // the root
        request.settings = square(kPooledSide);
        request.settings.integrator = Integrator::kPath;
        request.settings.room = Room::kMatte;
        request.settings.spp = 2;
        request.settings.first_hits = true;
        InstanceDescription turned{folder, {}, {}, {}};
        turned.placement = {{Vec3{0.8, -0.6, 0}, Vec3{0.48, 0.64, -0.6}, Vec3{0.36, 0.48, 0.8}}, 0.7, {0.1, 0, 0.2}};
        request.scene.instances.push_back(turned);
    }
    ~PooledTiles() override { std::filesystem::remove_all(folder); }

    /// Renders on the CPU and on a discrete GPU; the pictures must be the same. Returns that of the GPU.
    PooledPicture expectTheSame() {
        const PooledPicture expected = renderOn(cpu().device, request), pooled = renderOn(gpu().device, request);
        EXPECT_EQ(gpu().device.texel_pool->size(), 0u) << "the scene is gone";
        EXPECT_EQ(expected.blocks, 0u);
        EXPECT_EQ(pooled.film.rgba, expected.film.rgba);
        EXPECT_EQ(pooled.film.variance, expected.film.variance);
        EXPECT_EQ(pooled.film.depth, expected.film.depth);
        EXPECT_EQ(pooled.film.splat_id, expected.film.splat_id);
        EXPECT_EQ(pooled.film.tile_id, expected.film.tile_id);
        EXPECT_EQ(pooled.hit, expected.hit);
        return pooled;
    }

    std::string folder = temporaryPath("pooled.proset");
    LoadRequest request;
};

TEST_F(PooledTiles, RenderTheSamePicture_InBothForms) {
    for (const auto& [form, integrator] : {std::pair(KernelForm::kWavefront, Integrator::kWhitted),
                                           std::pair(KernelForm::kMegakernel, Integrator::kPath)}) {
        SCOPED_TRACE(testing::Message() << "integrator " << static_cast<int>(integrator));
        request.form = form;
        request.settings.integrator = integrator;
        const PooledPicture picture = expectTheSame();
        EXPECT_EQ(picture.traced, 1u);
        EXPECT_EQ(picture.blocks, 1u);
    }
}

/// Sets share a block but not their programs' tiles, and files are traced by themselves.
TEST_F(PooledTiles, RenderTheSamePicture_AmongOthersAndWithClips) {
    const SphereFile ball(3000);
    InstanceDescription set = request.scene.instances[0], file{ball.path, {}, {}, {}};
    set.placement.translation = {0.5, 1.2, 0};
    file.placement = {{}, 0.3, {-1, 0.5, 0.4}};
    file.placement.rotation = set.placement.rotation;
    request.scene.instances.push_back(file);
    request.scene.instances.push_back(set);
    request.scene.clips = {{ClipPlane{{0, 0, 0.5}, {0, 0, -1}}}};
    EXPECT_EQ(expectTheSame().traced, 3u);
}

/// The splats of painted scans are in other buffers.
TEST_F(PooledTiles, ThatArePainted_AreTracedOneByOne) {
    request.settings.color_by = "height";
    EXPECT_EQ(expectTheSame().traced, kTiles);
}

class PooledBalls : public PooledTiles {
protected:
    PooledBalls() : PooledTiles(true) {}
};

TEST_F(PooledBalls, RenderTheSamePicture) { EXPECT_EQ(expectTheSame().traced, 1u); }

/// Tiles around the camera, which sees one of them; the mirror shows the others.
TEST_F(PooledTiles, ThatRaysMeetUnseen_AreTheSame) {
    request.scene.instances[0].placement = {};
    request.settings.camera.eye = {0, 0, 0};
    request.settings.camera.target = {1, 1, 1};
    const PooledPicture picture = expectTheSame();
    EXPECT_GT(std::count(picture.hit.begin(), picture.hit.end(), true), 4);
}

TEST_F(PooledTiles, TakeAsManyDispatchesAsOneFile) {
    std::uint64_t dispatches[2] = {};
    const SphereFile whole(3000);
    for (const std::size_t scene : {0u, 1u}) {
        if (scene == 1) request.scene.instances[0].path = whole.path;
        const std::unique_ptr<LoadedScene> loaded = loadScene(gpu().device, gpu().device, request, {});
        const RenderSettings& settings = request.settings;
        RayCounts rays;
        BandSample sample =
            openBand(loaded->tracer, settings, loaded->camera, {0, kPooledSide}, {kPooledSide * kPooledSide, 0});
        const Counts counts;
        tracePasses(gpu().device, loaded->tracer, sample, settings.bounces, rays);
        EXPECT_TRUE(sample.done);
        dispatches[scene] = counts.of("dispatches");
    }
    EXPECT_EQ(dispatches[0], dispatches[1]);
}

} // namespace
} // namespace pointrt::test
