// SPDX-License-Identifier: Apache-2.0
// Loading and updating scenes in the background.
#include "runtime/window/edit/load_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "runtime/scene/camera.h"
#include "runtime/window/edit/pick_details.h"
#include "runtime/window/edit/required_update.h"
#include "runtime/window/live/viewport_renderer.h"
#include "tests/format/tiny_attributes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

using namespace std::chrono_literals;

constexpr const char* kScan =
    "[camera]\neye = [11, 21.5, 38]\ntarget = [11, 21.5, 31]\n" // the same with and without shapes
    "[[instance]]\nfile = 'tiny.pro'\n";
constexpr const char* kGlassBall = "[material.glass]\nkind = 'glass'\n"
                                   "[[shape]]\ntype = 'sphere'\ncenter = [11.1, 21.4, 30.8]\nradius = 0.3\n"
                                   "material = 'glass'\n"
                                   "[[shape]]\ntype = 'disc'\ncenter = [11, 20.4, 30.8]\nradius = 3\n"
                                   "normal = [0, 1, 0]\n";

std::string lamp(const char* position) {
    return std::string("[[light]]\ntype = 'point'\nposition = ") + position + "\nintensity = 6\n";
}

class LoadJobTest : public DeviceFixture {
protected:
    LoadJobTest() { test::tinyScene().write(folder.file("tiny.pro")); }

    Options optionsFor(const std::string& path) const {
        Options options;
        options.scene = path;
        options.choices.size = PixelSize{32, 24};
        options.choices.integrator = integrator;
        options.choices.caustics = caustics;
        return options;
    }

    static void wait(const Job& job) {
        for (int i = 0; i < 60000 && !job.ended(); ++i) std::this_thread::sleep_for(1ms);
    }

    std::unique_ptr<LoadedScene> load(const std::string& path) {
        LoadJob load(device, optionsFor(path));
        wait(load.job());
        EXPECT_EQ(load.job().state(), JobState::kDone) << load.job().error();
        return load.take();
    }
    std::unique_ptr<LoadedScene> loadText(const std::string& text) { return load(folder.write("scene.toml", text)); }

    std::string failure(const std::string& path) {
        LoadJob load(device, optionsFor(path));
        wait(load.job());
        EXPECT_EQ(load.job().state(), JobState::kFailed);
        EXPECT_EQ(load.take(), nullptr);
        return load.job().error();
    }

    static Viewport viewOf(const LoadedScene& loaded) {
        Viewport view;
        view.settings = loaded.settings;
        view.settings.spp = 2;
        view.camera = loaded.camera;
        view.look.scale = loaded.scene.space.scale;
        return view;
    }

    static std::vector<float> finish(ViewportRenderer& live) {
        for (int i = 0; i < 60000 && !live.progress().resting; ++i) {
            live.clearUpdates();
            live.work(0.01);
            if (live.updates().empty()) std::this_thread::sleep_for(1ms);
        }
        EXPECT_TRUE(live.progress().resting);
        return live.readFilm().rgba;
    }

    std::vector<float> picture(LoadedScene& loaded) {
        ViewportRenderer live(device, loaded.tracer, 0.01);
        live.setView(viewOf(loaded), false);
        return finish(live);
    }

    void relight(LoadedScene& loaded, const LoadedScene& like) {
        update(loaded, like.scene.description, like.settings);
    }

    void update(LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings) {
        SceneUpdateJob job(device, loaded, description, settings);
        wait(job.job());
        EXPECT_EQ(job.job().state(), JobState::kDone) << job.job().error();
    }

    /// Whether an update was done without a job.
    bool updatesTables(LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings) {
        RequiredUpdate rework = requiredUpdate(loaded.scene, loaded.program_kinds.integrator, description, settings);
        if (rework.kind != UpdateKind::kTables) return false;
        updateSceneTables(device, loaded, description, settings, std::move(rework));
        return true;
    }

    /// An image of one colour, 2^exponent times (0.25, 0.375, 0.5).
    std::string writeSky(const char* name, int exponent) const {
        std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
        for (int i = 0; i < 8; ++i) text += {'\x40', '\x60', '\x7f', static_cast<char>(128 + exponent)};
        return folder.write(name, text);
    }

    const test::TemporaryFolder folder;
    Integrator integrator = Integrator::kWhitted;
    bool caustics = false; ///< off, because they take a second each time
};

TEST_F(LoadJobTest, LoadsAScanWithSurroundings) {
    LoadJob load(device, optionsFor(folder.file("tiny.pro")));
    double before = 0;
    while (!load.job().ended()) {
        const JobStatus status = load.job().status();
        EXPECT_EQ(status.title, "Loading tiny.pro");
        EXPECT_GE(status.progress.value_or(0), before);
        before = status.progress.value_or(0);
        std::this_thread::sleep_for(1ms);
    }
    const auto loaded = load.take();
    ASSERT_NE(loaded, nullptr) << load.job().error();
    EXPECT_EQ(load.take(), nullptr) << "once";
    EXPECT_EQ(loaded->scene.splat_count, 5u);
    EXPECT_TRUE(loaded->described.lights.empty());
    EXPECT_EQ(loaded->scene.description.lights.size(), 3u) << "the studio's";
    EXPECT_EQ(loaded->camera.eye, loaded->staged_for);
    EXPECT_FALSE(loaded->lacks_photons);
    const std::vector<float> pixels = picture(*loaded);
    EXPECT_EQ(pixels.size(), 32u * 24 * 4);
    EXPECT_NE(pixels[4 * (12 * 32 + 16)], pixels[0]) << "something is there";
    relight(*loaded, *loaded);
    EXPECT_EQ(picture(*loaded), pixels);
    EXPECT_EQ(loaded->scene.description.lights.size(), 3u) << "no more than at first";
}

TEST_F(LoadJobTest, ReportsErrors) {
    EXPECT_EQ(failure(folder.write("broken.pro", "no scene at all")).find(folder.file("broken.pro") + ": "), 0u);
    EXPECT_EQ(failure(folder.file("none.pro")).find(folder.file("none.pro") + ": "), 0u);
    EXPECT_EQ(failure(folder.write("bad.toml", "[[light]]\n")).find(folder.file("bad.toml") + ":1: "), 0u);
}

TEST_F(LoadJobTest, DestructorCancelsLoading) {
    for (int i = 0; i < 3; ++i) {
        LoadJob load(device, optionsFor(folder.file("tiny.pro")));
        std::this_thread::sleep_for(i * 10ms);
    }
    LoadJob load(device, optionsFor(folder.file("tiny.pro")));
    load.job().cancel();
    wait(load.job());
    EXPECT_EQ(load.job().state(), JobState::kCancelled);
    EXPECT_EQ(load.take(), nullptr);
}

TEST_F(LoadJobTest, MovesALightImmediately) {
    const auto loaded = loadText(kScan + lamp("[10, 24, 36]")), moved = loadText(kScan + lamp("[14, 22, 35]"));
    ViewportRenderer live(device, loaded->tracer, 0.01);
    live.setView(viewOf(*loaded), false);
    const std::vector<float> before = finish(live), expected = picture(*moved);
    EXPECT_NE(before, expected);
    ASSERT_TRUE(updatesTables(*loaded, moved->scene.description, moved->settings));
    EXPECT_FALSE(loaded->lacks_photons);
    live.restart(true);
    EXPECT_EQ(finish(live), expected);
}

TEST_F(LoadJobTest, AddsLightsUpToTheLimit) {
    const std::string one = kScan + lamp("[10, 24, 36]");
    const auto loaded = loadText(one);
    ViewportRenderer live(device, loaded->tracer, 0.01);
    live.setView(viewOf(*loaded), false);
    const auto change = [&](const LoadedScene& like) {
        EXPECT_TRUE(updatesTables(*loaded, like.scene.description, like.settings));
        live.restart(false);
        return finish(live);
    };
    std::string text = one;
    for (const char* place : {"[14, 22, 35]", "[12, 26, 31]"}) {
        text += lamp(place);
        const auto more = loadText(text);
        EXPECT_EQ(change(*more), picture(*more));
    }
    const auto fewer = loadText(kScan + lamp("[14, 22, 35]"));
    EXPECT_EQ(change(*fewer), picture(*fewer));
}

/// The tiny scan with all attributes and Z up.
constexpr const char* kUprightScan = "[[instance]]\nfile = 'said.pro'\n";

void writeUprightScan(const std::string& path) {
    test::Scene tiny = test::tinyScene();
    const test::TinyScan said;
    const pro_view view = tiny.view();
    const pro_content content{&tiny.info,
                              &view,
                              nullptr,
                              &said.world,
                              said.attributes.data(),
                              static_cast<std::uint32_t>(said.attributes.size()),
                              nullptr};
    EXPECT_EQ(pro_write_content(path.c_str(), &content, 1, nullptr), PRO_OK);
}

TEST_F(LoadJobTest, ColourChangesNeedAJob) {
    writeUprightScan(folder.file("said.pro"));
    const std::string plain = kUprightScan + lamp("[10, 24, 36]");
    const auto loaded = loadText(plain);
    const std::vector<float> before = picture(*loaded);
    const std::uint64_t bytes = loaded->scene.device_bytes;
    const auto classes = loadText("[render]\ncolor_by = 'class'\n" + plain);
    const auto intensity = loadText("[render]\ncolor_by = 'intensity'\n" + plain);
    EXPECT_NE(picture(*classes), before);
    EXPECT_NE(picture(*intensity), picture(*classes));
    for (const LoadedScene* like : {classes.get(), intensity.get()}) {
        EXPECT_FALSE(updatesTables(*loaded, like->scene.description, like->settings));
        relight(*loaded, *like);
        EXPECT_EQ(picture(*loaded), picture(const_cast<LoadedScene&>(*like)));
        EXPECT_TRUE(loaded->scene.paint.legend);
        EXPECT_EQ(loaded->scene.device_bytes, bytes + 5 * 16);
    }
    const auto again = loadText(plain);
    relight(*loaded, *again);
    EXPECT_EQ(picture(*loaded), before);
    EXPECT_EQ(loaded->scene.device_bytes, bytes);
    EXPECT_FALSE(loaded->scene.paint.legend);
}

TEST_F(LoadJobTest, PicksReportTheColouringValue) {
    writeUprightScan(folder.file("said.pro"));
    const auto valueText = [&](const char* word, std::uint32_t splat) {
        const auto loaded = loadText("[render]\ncolor_by = '" + std::string(word) + "'\n" + kUprightScan);
        Pick pick;
        pick.splat = splat;
        return describePick(loaded->scene, pick).value;
    };
    EXPECT_EQ(valueText("class", 2), "classification 6, building");
    EXPECT_EQ(valueText("gps_time", 0), "gps_time 1000000000.25");
    EXPECT_EQ(valueText("height", 0), "height 30.5000005"); // the middle of a step of 2^-20 above 30.5
    EXPECT_EQ(valueText("rgb", 2), "");
    EXPECT_EQ(valueText("normal", 2), "");
}

TEST_F(LoadJobTest, ScansWithAnUpAxisStandUpright) {
    writeUprightScan(folder.file("said.pro"));
    const auto alone = load(folder.file("said.pro"));
    EXPECT_EQ(alone->scene.description.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(alone->described.up, (Vec3{0, 0, 1}));
    EXPECT_LT(alone->camera.forward.z, -0.999) << "from where its scanner stood";
    const auto turned = loadText("[[instance]]\nfile = 'tiny.pro'\n[[instance]]\nfile = 'said.pro'\n"
                                 "rotate = { axis = [1, 0, 0], degrees = -90 }\n");
    EXPECT_LT(length(turned->scene.description.up.value() - Vec3{0, 1, 0}), 1e-12) << "as it stands there";
    EXPECT_FALSE(load(folder.file("tiny.pro"))->scene.description.up);
    EXPECT_EQ(loadText(kScan)->scene.description.up, (Vec3{0, 1, 0}));
}

TEST_F(LoadJobTest, ProgramChangesNeedAJob) {
    const auto loaded = loadText(kScan + lamp("[10, 24, 36]"));
    const std::vector<float> before = picture(*loaded);
    const auto round = loadText(kScan + lamp("[10, 24, 36]") +
                                "[[light]]\ntype = 'sphere'\ncenter = [14, 22, 35]\n"
                                "radius = 0.2\nradiance = 90\n");
    EXPECT_FALSE(updatesTables(*loaded, round->scene.description, round->settings));
    RenderSettings path = loaded->settings;
    path.integrator = Integrator::kPath;
    EXPECT_FALSE(updatesTables(*loaded, loaded->scene.description, path));
    EXPECT_EQ(picture(*loaded), before) << "nothing was changed";
    relight(*loaded, *round);
    EXPECT_EQ(picture(*loaded), picture(*round));
    integrator = Integrator::kPath;
    const auto traced = loadText(kScan + lamp("[10, 24, 36]"));
    relight(*loaded, *traced);
    EXPECT_EQ(picture(*loaded), picture(*traced));
}

TEST_F(LoadJobTest, PhotonsAreDeferred) {
    const auto loaded = loadText(kScan + lamp("[10, 24, 36]"));
    caustics = true;
    const auto ball = loadText(kScan + std::string(kGlassBall) + lamp("[11, 25, 31]")),
               moved = loadText(kScan + std::string(kGlassBall) + lamp("[12, 25, 31]"));
    const std::vector<float> expected = picture(*moved);
    relight(*loaded, *ball);
    EXPECT_GT(loaded->tracer.caustics.first.frame.count.x, 0u);
    EXPECT_FALSE(loaded->lacks_photons);
    EXPECT_EQ(picture(*loaded), picture(*ball));
    ASSERT_TRUE(updatesTables(*loaded, moved->scene.description, moved->settings));
    EXPECT_TRUE(loaded->lacks_photons);
    EXPECT_EQ(loaded->tracer.caustics.first.frame.count.x, 0u);
    const std::vector<float> without = picture(*loaded);
    EXPECT_NE(without, expected);
    {
        SceneUpdateJob job(device, *loaded, moved->scene.description, moved->settings);
        job.job().cancel();
        wait(job.job());
        EXPECT_FALSE(loaded->lacks_photons) << "nobody wants to wait for them";
        if (job.job().state() == JobState::kCancelled) { // cancelled before it finished
            EXPECT_EQ(picture(*loaded), without);
        }
    }
    relight(*loaded, *moved);
    EXPECT_FALSE(loaded->lacks_photons);
    EXPECT_EQ(picture(*loaded), expected);
}

TEST_F(LoadJobTest, ReadsASkyOnce) {
    writeSky("dim.hdr", 0);
    writeSky("bright.hdr", 1);
    const auto sky = [](const char* image, const char* rest) {
        return std::string(kScan) + "[sky]\nimage = '" + image + "'\n" + rest;
    };
    const auto loaded = loadText(sky("dim.hdr", "")), bright = loadText(sky("bright.hdr", "")),
               turned = loadText(sky("dim.hdr", "strength = 0.5\nrotation = 30\n")),
               none = loadText(kScan + lamp("[10, 24, 36]"));
    EXPECT_FALSE(updatesTables(*loaded, bright->scene.description, bright->settings));
    SceneDescription gone = bright->scene.description;
    gone.sky->image = folder.file("none.hdr");
    SceneUpdateJob job(device, *loaded, gone, bright->settings);
    wait(job.job());
    EXPECT_EQ(job.job().state(), JobState::kFailed);
    EXPECT_EQ(job.job().error().find(folder.file("none.hdr") + ": "), 0u) << job.job().error();
    EXPECT_EQ(loaded->scene.description.sky->image, folder.file("dim.hdr"));
    relight(*loaded, *bright);
    EXPECT_EQ(picture(*loaded), picture(*bright));
    relight(*loaded, *none);
    EXPECT_EQ(picture(*loaded), picture(*none));
    relight(*loaded, *turned);
    EXPECT_EQ(picture(*loaded), picture(*turned));
    std::filesystem::remove(folder.file("dim.hdr"));
    relight(*loaded, *turned);
    EXPECT_EQ(picture(*loaded), picture(*turned)) << "without reading it again";
}

TEST_F(LoadJobTest, ScansMoveAndReturn) {
    const auto loaded = loadText(kScan + lamp("[10, 24, 36]"));
    const std::vector<float> before = picture(*loaded);
    SceneDescription moved = loaded->scene.description;
    const Placement loaded_placement = moved.instances[0].placement;
    moved.instances[0].placement.translation.x += 0.3;
    RequiredUpdate drag = requiredUpdate(loaded->scene, loaded->program_kinds.integrator, moved, loaded->settings);
    ASSERT_EQ(drag.kind, UpdateKind::kPlacements);
    updateSceneTables(device, *loaded, moved, loaded->settings, std::move(drag));
    const std::vector<float> dragged = picture(*loaded);
    EXPECT_NE(dragged, before);
    moved.instances[0].placement = loaded_placement;
    update(*loaded, moved, loaded->settings);
    EXPECT_EQ(picture(*loaded), before) << "by a job";
}

TEST_F(LoadJobTest, OtherScansNeedAReload) {
    const auto loaded = loadText(kScan + lamp("[10, 24, 36]"));
    const std::vector<float> before = picture(*loaded);
    SceneDescription other = loaded->scene.description;
    other.instances.push_back(other.instances[0]);
    EXPECT_FALSE(updatesTables(*loaded, other, loaded->settings));
    SceneUpdateJob job(device, *loaded, other, loaded->settings);
    wait(job.job());
    EXPECT_EQ(job.job().state(), JobState::kFailed);
    EXPECT_EQ(picture(*loaded), before);
}

} // namespace
} // namespace pointrt
