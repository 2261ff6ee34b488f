// SPDX-License-Identifier: Apache-2.0
// Instance culling: rays are traced only through instances whose boxes they cross. Pictures are bit-identical to those
// without culling, and few rays are traced.
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

constexpr std::uint32_t kCullingSide = 64;

/// A rotation about an oblique axis, so that boxes lie along no axis of render space.
std::array<Vec3, 3> turnedBy(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3{c, -0.6 * s, 0.8 * s}, Vec3{0.6 * s, 0.64 + 0.36 * c, 0.48 - 0.48 * c},
            Vec3{-0.8 * s, 0.48 - 0.48 * c, 0.36 + 0.64 * c}};
}

class InstanceCulling : public DeviceFixture {
protected:
    InstanceCulling() : ball(3000) {
        const Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1);
        writeHandCutSet(folder, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, splats.radii[0]}, splats, splats);
    }
    ~InstanceCulling() override { std::filesystem::remove_all(folder); }
    void SetUp() override { profile.clock = createPassClock(device); }
    void TearDown() override { destroyPassClock(device, profile.clock); }

    /// Scattered balls of different sizes.
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

    /// Eight rotated tiles, and balls around them.
    SceneDescription turnedSet(std::uint32_t balls) const {
        SceneDescription scene = crowd(balls);
        InstanceDescription set{folder, {}, {}, {}};
        set.placement = {turnedBy(0.4), 0.7, {0.1, 0, 0.2}};
        scene.instances.insert(scene.instances.begin() + balls / 2, set);
        return scene;
    }

    Film render(const SceneDescription& scene, RenderSettings settings, FormRequest form, bool culls) {
        settings.caustics = false; // photon maps are traced before the groups are taken away below
        settings.first_hits = true;
        LoadRequest request;
        request.scene = scene;
        request.settings = settings;
        request.form = form;
        const std::unique_ptr<LoadedScene> loaded = loadScene(device, device, request, {});
        BandTracer& tracer = loaded->tracer;
        groups = tracer.instances.cull_groups.size();
        std::vector<CullGroup> unused;
        if (!culls) unused.swap(tracer.instances.cull_groups);
        tracer.profile = &profile;
        ProgressiveRenderer renderer(device, tracer);
        FrameJob job;
        job.samples = settings.spp;
        renderer.begin({settings, loaded->camera, tilingFor(device, settings.width, settings.height)}, job);
        renderer.run();
        if (!culls) unused.swap(tracer.instances.cull_groups); // they are freed together with the scene
        return renderer.takeFilm();
    }

    void expectTheSame(const SceneDescription& scene, Integrator integrator, FormRequest form) {
        RenderSettings settings = square(kCullingSide);
        settings.integrator = integrator;
        settings.room = integrator == Integrator::kPath ? Room::kMatte : Room::kMirror;
        settings.reflectivity = 0.3f;
        settings.spp = 2;
        const Film culled = render(scene, settings, form, true), whole = render(scene, settings, form, false);
        EXPECT_EQ(culled.rgba, whole.rgba);
        EXPECT_EQ(culled.variance, whole.variance);
        EXPECT_EQ(culled.depth, whole.depth);
        EXPECT_EQ(culled.splat_id, whole.splat_id);
    }

    /// Checks all integrators that show light, and both kernel forms.
    void expectAlwaysTheSame(const SceneDescription& scene) {
        for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
            for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath}) {
                SCOPED_TRACE(testing::Message()
                             << "integrator " << static_cast<int>(integrator) << ", form " << static_cast<int>(form));
                expectTheSame(scene, integrator, form);
            }
    }

    /// Lanes that a pass worked on and entries that it listed in the last frame; 0 if it did not run.
    std::pair<std::uint64_t, std::uint64_t> lanesOf(const std::string& pass) const {
        for (const PassTally& each : profile.passes)
            if (each.name == pass) return {each.lanes_in, each.lanes_out};
        return {};
    }

    SphereFile ball;
    std::string folder = temporaryPath("turned.proset");
    PassProfile profile;
    std::size_t groups = 0; ///< cull groups of the scene rendered last
};

TEST_F(InstanceCulling, TilesAreCulledWithoutChange) {
    expectAlwaysTheSame(turnedSet(0));
    EXPECT_EQ(groups, 1u);
}

TEST_F(InstanceCulling, ManyInstancesAreCulledWithoutChange) {
    expectAlwaysTheSame(crowd(40));
    EXPECT_EQ(groups, 2u); // 32 and 8
}

/// Tiles are not in a group with other instances.
TEST_F(InstanceCulling, TilesAmongInstancesAreCulledWithoutChange) {
    expectTheSame(turnedSet(6), Integrator::kPath, {});
    EXPECT_EQ(groups, 3u); // three balls, eight tiles, three balls
}

TEST_F(InstanceCulling, FewInstancesAreNotCulled) {
    render(crowd(3), square(kCullingSide), {}, true);
    EXPECT_EQ(groups, 0u);
    EXPECT_EQ(lanesOf("cull_shadow").first, 0u);
}

TEST_F(InstanceCulling, TilesAreTracedForFewRays) {
    const SceneDescription scene = turnedSet(0);
    const RenderSettings settings = square(kCullingSide);
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

/// Balls in one place, so that every shadow ray must be tested against all of them, and many lamps: more entries than
/// lists have room for.
TEST_F(InstanceCulling, InstancesBeyondTheListsAreTracedForAllRays) {
    SceneDescription scene;
    for (int i = 0; i < 32; ++i) {
        InstanceDescription instance{ball.path, {}, {}, {}};
        instance.placement.rotation = turnedBy(i);
        instance.placement.scale = 1 + 0.01 * i;
        scene.instances.push_back(instance);
    }
    RenderSettings settings = square(kCullingSide);
    settings.room = Room::kMatte;
    settings.lights = 8;
    const Film culled = render(scene, settings, {}, true);
    EXPECT_GT(lanesOf("compact").second, 0u);
    EXPECT_GT(lanesOf("intersect_shadow").first, lanesOf("compact").second);
    EXPECT_EQ(culled.rgba, render(scene, settings, {}, false).rgba);
}

} // namespace
} // namespace pointrt::test
