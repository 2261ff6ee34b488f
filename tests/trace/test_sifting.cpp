// SPDX-License-Identifier: Apache-2.0
// Rays are sifted for the instances that they may meet: pictures are those of instances that are asked for all rays, to
// the bit, and few rays are asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "tests/support/hand_cut_set.h"
#include "tests/support/validated_device.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kSiftingSide = 64;

/// Turned about an axis that is none of space's: its boxes lie along no axis of render space.
std::array<Vec3, 3> turnedBy(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3{c, -0.6 * s, 0.8 * s}, Vec3{0.6 * s, 0.64 + 0.36 * c, 0.48 - 0.48 * c},
            Vec3{-0.8 * s, 0.48 - 0.48 * c, 0.36 + 0.64 * c}};
}

class Sifting : public DeviceFixture {
protected:
    Sifting() : ball(3000) {
        const Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1);
        writeHandCutSet(folder, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, splats.radii[0]}, splats, splats);
    }
    ~Sifting() override { std::filesystem::remove_all(folder); }
    void SetUp() override { profile.clock = createGpuTimer(device); }
    void TearDown() override { destroyGpuTimer(device, profile.clock); }

    /// Many balls here and there, of all sizes.
    SceneDescription crowd(std::uint32_t count) const {
        SceneDescription scene;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double turn = 2.4 * i, height = 2.0 * i / count - 1, ring = 1.5 * std::sqrt(1.01 - height * height);
            InstanceDescription instance{ball.path, {}, {}, {}};
            instance.placement = {
                turnedBy(0.7 * i), 0.1 + 0.02 * (i % 7), {ring * std::cos(turn), height, ring * std::sin(turn)}};
            scene.instances.push_back(instance);
        }
        return scene;
    }

    /// Eight tiles, turned, and balls beside them.
    SceneDescription turnedSet(std::uint32_t balls) const {
        SceneDescription scene = crowd(balls);
        InstanceDescription set{folder, {}, {}, {}};
        set.placement = {turnedBy(0.4), 0.7, {0.1, 0, 0.2}};
        scene.instances.insert(scene.instances.begin() + balls / 2, set);
        return scene;
    }

    Film render(const SceneDescription& scene, RenderSettings settings, FormRequest form, bool sifts) {
        settings.caustics = false; // what is kept in a map is sifted for before a picture is begun
        settings.first_hits = true;
        LoadRequest request;
        request.scene = scene;
        request.settings = settings;
        request.form = form;
        const std::unique_ptr<LoadedScene> loaded = loadScene(device, device, request, {});
        BandTracer& tracer = loaded->tracer;
        sieves = tracer.instances.cull_groups.size();
        std::vector<CullGroup> unused;
        if (!sifts) unused.swap(tracer.instances.cull_groups);
        tracer.profile = &profile;
        ProgressiveRenderer renderer(device, tracer);
        FrameJob job;
        job.samples = settings.spp;
        renderer.begin({settings, loaded->camera, tilingFor(device, settings.width, settings.height)}, job);
        renderer.run();
        if (!sifts) unused.swap(tracer.instances.cull_groups); // it is freed with the others
        return renderer.takeFilm();
    }

    void expectTheSame(const SceneDescription& scene, Integrator integrator, FormRequest form) {
        RenderSettings settings = square(kSiftingSide);
        settings.integrator = integrator;
        settings.room = integrator == Integrator::kPath ? Room::kMatte : Room::kMirror;
        settings.reflectivity = 0.3f;
        settings.spp = 2;
        const Film sifted = render(scene, settings, form, true), whole = render(scene, settings, form, false);
        EXPECT_EQ(sifted.rgba, whole.rgba);
        EXPECT_EQ(sifted.variance, whole.variance);
        EXPECT_EQ(sifted.depth, whole.depth);
        EXPECT_EQ(sifted.splat_id, whole.splat_id);
    }

    /// In every integrator that shows light, and both forms.
    void expectAlwaysTheSame(const SceneDescription& scene) {
        for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
            for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath}) {
                SCOPED_TRACE(testing::Message()
                             << "integrator " << static_cast<int>(integrator) << ", form " << static_cast<int>(form));
                expectTheSame(scene, integrator, form);
            }
    }

    /// What a pass worked on, and what it listed, since the last call; 0 where it was not run.
    std::pair<std::uint64_t, std::uint64_t> lanesOf(const std::string& pass) const {
        for (const PassTally& each : profile.passes)
            if (each.name == pass) return {each.lanes_in, each.lanes_out};
        return {};
    }

    SphereFile ball;
    std::string folder = temporaryPath("turned.proset");
    PassProfile profile;
    std::size_t sieves = 0; ///< of the scene rendered last
};

TEST_F(Sifting, PicturesOfTilesAreTheSame) {
    expectAlwaysTheSame(turnedSet(0));
    EXPECT_EQ(sieves, 1u);
}

TEST_F(Sifting, PicturesOfManyInstancesAreTheSame) {
    expectAlwaysTheSame(crowd(40));
    EXPECT_EQ(sieves, 2u); // 32 and 8
}

/// Tiles are not sifted for together with what else there is.
TEST_F(Sifting, PicturesOfTilesAmongInstancesAreTheSame) {
    expectTheSame(turnedSet(6), Integrator::kPath, {});
    EXPECT_EQ(sieves, 3u); // three balls, eight tiles, three balls
}

TEST_F(Sifting, FewInstancesAreAskedForAll) {
    render(crowd(3), square(kSiftingSide), {}, true);
    EXPECT_EQ(sieves, 0u);
    EXPECT_EQ(lanesOf("cull_shadow").first, 0u);
}

TEST_F(Sifting, TilesAreAskedForFewRays) {
    const SceneDescription scene = turnedSet(0);
    const RenderSettings settings = square(kSiftingSide);
    render(scene, settings, {}, false);
    const std::uint64_t all = lanesOf("intersect_shadow").first;
    EXPECT_EQ(lanesOf("cull_shadow").first, 0u);
    clearProfile(profile);
    render(scene, settings, {}, true);
    EXPECT_GT(lanesOf("intersect_shadow").first, 0u);
    EXPECT_LT(lanesOf("intersect_shadow").first, all / 2);
    EXPECT_EQ(lanesOf("compact").second, lanesOf("intersect_shadow").first);
    EXPECT_EQ(lanesOf("cull_shadow").first, all / 8);
}

/// Balls in one place, each of which stands in the way of each shadow ray, and many lamps: more entries than there is
/// room for.
TEST_F(Sifting, TargetsWhoseListsDoNotFitAreAskedForAll) {
    SceneDescription scene;
    for (int i = 0; i < 32; ++i) {
        InstanceDescription instance{ball.path, {}, {}, {}};
        instance.placement.rotation = turnedBy(i);
        instance.placement.scale = 1 + 0.01 * i;
        scene.instances.push_back(instance);
    }
    RenderSettings settings = square(kSiftingSide);
    settings.room = Room::kMatte;
    settings.lights = 8;
    const Film sifted = render(scene, settings, {}, true);
    EXPECT_GT(lanesOf("compact").second, 0u);
    EXPECT_GT(lanesOf("intersect_shadow").first, lanesOf("compact").second);
    EXPECT_EQ(sifted.rgba, render(scene, settings, {}, false).rgba);
}

} // namespace
} // namespace pointrt::test
