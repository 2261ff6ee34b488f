// SPDX-License-Identifier: Apache-2.0
// When the window's picture restarts, and how picks and films are taken from it.
#include "runtime/window/live/image_controller.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "runtime/scene/camera.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

ImageRequest request() {
    ImageRequest wanted;
    wanted.view.settings.width = 40;
    wanted.view.settings.height = 32;
    wanted.view.settings.spp = 3;
    wanted.view.settings.integrator = Integrator::kPhong;
    wanted.view.camera = frameCamera({}, {-1, 0, -1}, {1, 2, 1}, 40.0 / 32);
    return wanted;
}

TEST(ImageChange, IsMinimal) {
    const ImageRequest wanted = request();
    const auto change = [&](const std::function<void(ImageRequest&)>& edit) {
        ImageRequest next = wanted;
        edit(next);
        return changeOf(wanted.view, next, false);
    };
    EXPECT_EQ(changeOf(std::nullopt, wanted, false), ImageChange::kStartOver) << "the first one";
    EXPECT_EQ(changeOf(wanted.view, wanted, true), ImageChange::kStartOver);
    EXPECT_EQ(change([](ImageRequest&) {}), ImageChange::kNone);
    EXPECT_EQ(change([](ImageRequest& r) { r.view.camera.eye.x += 1; }), ImageChange::kStartOver);
    EXPECT_EQ(change([](ImageRequest& r) { r.view.settings.width += 1; }), ImageChange::kStartOver);
    EXPECT_EQ(change([](ImageRequest& r) { r.view.settings.height += 1; }), ImageChange::kStartOver);
    EXPECT_EQ(change([](ImageRequest& r) { r.look_changed = true; }), ImageChange::kLook);
    EXPECT_EQ(change([](ImageRequest& r) { r.view.settings.spp = 9; }), ImageChange::kNone) << "it only goes on";
    EXPECT_EQ(change([](ImageRequest& r) { r.paused = true; }), ImageChange::kNone);
}

class ImageControllerTest : public DeviceFixture {
protected:
    void SetUp() override {
        SceneDescription description;
        description.materials.emplace_back();
        description.shapes.push_back({ShapeKind::kSphere, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0});
        description.lights.push_back(PointLight{{2, 4, 2}, {30, 30, 30}});
        scene = openScene(device, description, false);
        uploadSceneTables(device, scene, wanted.view.settings);
        createBandTracer(device, tracer, scene, wanted.view.settings, kSliceLanes, 1);
        wanted.view.look.scale = scene.space.scale;
        image.open(device, tracer);
    }
    void TearDown() override {
        image.close();
        destroyBandTracer(device, tracer);
        destroyDeviceScene(device, scene);
    }

    /// Runs frames until condition holds; false on timeout.
    bool runUntil(const std::function<bool()>& condition) {
        for (int frame = 0; frame < 20000 && !condition(); ++frame) {
            if (auto found = image.update(wanted)) result = found;
            wanted.look_changed = false;
            if (!image.work()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            image.live()->clearUpdates();
        }
        return condition();
    }
    bool rests() const { return image.live() && image.live()->progress().resting; }

    DeviceScene scene;
    BandTracer tracer;
    ImageRequest wanted = request();
    ImageController image;
    std::optional<PickResult> result;
};

TEST_F(ImageControllerTest, StartsOverWhenTheViewChanges) {
    EXPECT_EQ(image.live(), nullptr);
    image.update(wanted);
    EXPECT_FALSE(image.moved()) << "it comes from nowhere";
    EXPECT_EQ(image.size(), (PixelSize{40, 32}));
    EXPECT_TRUE(image.live()->view().settings.first_hits);
    ASSERT_TRUE(runUntil([&] { return rests(); }));
    image.update(wanted);
    EXPECT_FALSE(image.moved());
    EXPECT_EQ(image.live()->progress().samples, 3u);
    wanted.view.camera.eye.x += 0.1;
    image.update(wanted);
    EXPECT_TRUE(image.moved());
    EXPECT_EQ(image.live()->progress().samples, 0u);
    image.skipFrame();
    EXPECT_FALSE(image.moved());
    ASSERT_TRUE(runUntil([&] { return rests(); }));
    image.restart(ViewChange::kScene);
    image.update(wanted);
    EXPECT_EQ(image.live()->progress().samples, 0u) << "another scene";
    wanted.view.settings.spp = 5;
    ASSERT_TRUE(runUntil([&] { return rests(); }));
    EXPECT_EQ(image.live()->progress().samples, 5u);
}

TEST_F(ImageControllerTest, AnotherLookTracesNothing) {
    ASSERT_TRUE(runUntil([&] { return rests(); }));
    wanted.view.look.exposure = 1;
    wanted.look_changed = true;
    image.update(wanted);
    EXPECT_FALSE(image.moved());
    EXPECT_EQ(image.live()->progress().samples, 3u);
    EXPECT_FALSE(image.live()->updates().empty()) << "there is something to show";
    EXPECT_EQ(image.live()->view().look.exposure, 1);
}

TEST_F(ImageControllerTest, PauseStillCompletesRequests) {
    wanted.paused = true;
    ASSERT_TRUE(runUntil([&] { return image.live() && image.live()->progress().samples > 0; })) << "a first picture";
    image.update(wanted);
    EXPECT_FALSE(image.mayWork());
    EXPECT_FALSE(image.work());
    EXPECT_FALSE(image.hasPendingRequest());
    image.requestFilm();
    EXPECT_TRUE(image.hasPendingRequest());
    EXPECT_TRUE(image.mayWork());
    ASSERT_TRUE(runUntil([&] { return image.isFilmReady(); }));
    EXPECT_EQ(image.takeFilm().rgba.size(), 40u * 32 * 4);
    EXPECT_FALSE(image.isFilmRequested());
    EXPECT_FALSE(image.mayWork());
}

TEST_F(ImageControllerTest, ResolvesPicks) {
    image.pick({0.5, 0.5, true});
    EXPECT_TRUE(image.hasPendingRequest());
    ASSERT_TRUE(runUntil([&] { return result.has_value(); }));
    EXPECT_TRUE(result->centre);
    EXPECT_NEAR(result->pick.position.z, 1, 0.05) << "the ball's front";
    EXPECT_FALSE(image.hasPendingRequest());
    result.reset();
    image.pick({0, 0});
    ASSERT_TRUE(runUntil([&] { return !image.hasPendingRequest(); }));
    EXPECT_FALSE(result) << "nothing is there";
    image.pick({1, 1}); // the last pixel
    ASSERT_TRUE(runUntil([&] { return !image.hasPendingRequest(); }));
}

TEST_F(ImageControllerTest, SwitchesScenes) {
    ASSERT_TRUE(runUntil([&] { return rests(); }));
    image.requestFilm();
    image.open(device, tracer);
    EXPECT_EQ(image.live(), nullptr);
    image.update(wanted);
    EXPECT_FALSE(image.moved()) << "nothing of it was there to move";
    EXPECT_TRUE(image.isFilmRequested());
}

} // namespace
} // namespace pointrt
