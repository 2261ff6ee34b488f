// SPDX-License-Identifier: Apache-2.0
// The host records a frame while the device, a pretended GPU, traces the last: what a frame of the window takes, and
// that pictures are those of frames one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/render/loaded_scene.h"
#include "runtime/window/live/viewport_renderer.h"
#include "runtime/window/platform/presenter.h"
#include "tests/gpu/offline/pretended.h"
#include "tests/support/validated_device.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kWindowSide = 48;
/// Time for a frame: enough for whole frames, however slow the machine.
constexpr double kFrame_s = 10;

const std::map<std::string, std::string> kDiscrete = {{"POINTRT_LAYER_TYPE", "discrete"},
                                                      {"POINTRT_LAYER_MEMORY", "discrete"}};
/// The host reads and writes the device's memory in place.
const std::map<std::string, std::string> kIntegrated = {{"POINTRT_LAYER_TYPE", "integrated"},
                                                        {"POINTRT_LAYER_MEMORY", "incoherent"}};

DeviceRequest forWindows() {
    DeviceRequest request;
    request.graphics = true;
    return request;
}

/// A window's picture of a ball in a room, and its presentation off screen.
class WindowPicture {
public:
    explicit WindowPicture(const SphereFile& ball, std::uint32_t samples) : validated(forWindows()) {
        LoadRequest request;
        request.scene.instances.push_back({ball.path, {}, {}, {}});
        request.settings = square(kWindowSide);
        request.settings.integrator = Integrator::kPath;
        request.settings.bounces = 4;
        request.settings.room = Room::kMatte;
        request.settings.spp = samples;
        loaded = loadScene(validated.device, validated.device, request, {});
        view.settings = loaded->settings;
        view.camera = loaded->camera;
        view.look.scale = loaded->scene.space.scale;
        live = std::make_unique<ViewportRenderer>(validated.device, loaded->tracer, kFrame_s);
        presenter = createPresenter(validated.device, VK_NULL_HANDLE, kWindowSide, kWindowSide);
    }
    ~WindowPicture() {
        destroyPresenter(validated.device, presenter);
        live.reset();
    }
    WindowPicture(const WindowPicture&) = delete;
    WindowPicture& operator=(const WindowPicture&) = delete;

    /// Moves the camera, traces a picture and shows it.
    void moveBy(double step) {
        view.camera.eye.x += step;
        live->setView(view, true);
        frame();
    }

    void frame() {
        live->work(kFrame_s);
        const std::vector<PictureUpdate> updates = live->updates();
        live->clearUpdates();
        present(validated.device, presenter, nullptr, [&](VkCommandBuffer commands) {
            for (const PictureUpdate& each : updates)
                recordUploadRows(commands, presenter, live->pixels(), each.first_row, each.rows);
        });
    }

    Film refine() {
        live->setView(view, false);
        while (!live->progress().resting) frame();
        return live->readFilm();
    }

    Image8 shown() { return readCanvas(validated.device, presenter); }

    ValidatedDevice validated;
    std::unique_ptr<LoadedScene> loaded;
    Viewport view;
    std::unique_ptr<ViewportRenderer> live;
    Presenter presenter;
};

class FramesInFlight : public testing::Test {
protected:
    SphereFile ball{3000};
};

TEST_F(FramesInFlight, TakeTwoSubmissionsAWaitAndNoMemory) {
    const Environment environment(layered(kDiscrete));
    WindowPicture window(ball, 2);
    for (int i = 0; i < 4; ++i) window.moveBy(0.01);
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        const Counts counts;
        window.moveBy(0.01);
        EXPECT_EQ(counts.of("submits"), 2u) << "the picture, and its presentation";
        EXPECT_LE(counts.of("waits"), 1u);
        EXPECT_EQ(counts.of("allocations"), 0u);
    }
}

/// The CPU form traces the megakernel whole, without overlap.
TEST_F(FramesInFlight, ShowTheSamePictures) {
    constexpr std::uint32_t kSamples = 5;
    std::vector<Film> films;
    std::vector<Image8> shown;
    for (const auto& variables : {std::map<std::string, std::string>(), layered(kDiscrete), layered(kIntegrated)}) {
        const Environment environment(variables);
        WindowPicture window(ball, kSamples);
        for (int i = 0; i < 5; ++i) window.moveBy(0.02);
        shown.push_back(window.shown());
        films.push_back(window.refine());
        shown.push_back(window.shown());
    }
    for (const std::size_t device : {1u, 2u}) {
        SCOPED_TRACE(device);
        EXPECT_EQ(films[device].rgba, films[0].rgba);
        EXPECT_EQ(films[device].variance, films[0].variance);
        EXPECT_EQ(shown[2 * device].pixels, shown[0].pixels);
        EXPECT_EQ(shown[2 * device + 1].pixels, shown[1].pixels);
    }
    EXPECT_NE(shown[0].pixels, shown[1].pixels) << "a preview and a finished picture";
}

/// Frames of two sizes in turn, so that buffers are replaced that the last frame still uses.
TEST_F(FramesInFlight, OutliveWhatTheyReplace) {
    const Environment environment(layered(kDiscrete));
    WindowPicture window(ball, 2);
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t side = i % 2 ? kWindowSide : kWindowSide / 2 + 8 * static_cast<std::uint32_t>(i);
        window.view.settings.width = window.view.settings.height = side;
        resizeCanvas(window.validated.device, window.presenter, side, side);
        window.moveBy(0.01);
    }
    EXPECT_EQ(window.live->progress().size, (PixelSize{kWindowSide, kWindowSide}));
}

} // namespace
} // namespace pointrt::test
