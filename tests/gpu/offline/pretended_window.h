// SPDX-License-Identifier: Apache-2.0
// The window's picture of a ball in a room, on a pretended device.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/render/loaded_scene.h"
#include "runtime/window/live/viewport_renderer.h"
#include "runtime/window/platform/presenter.h"
#include "tests/support/validated_device.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

constexpr std::uint32_t kWindowSide = 48;
/// Time for a frame: long enough for complete frames even on a slow machine.
constexpr double kFrame_s = 10;

inline const std::map<std::string, std::string> kDiscrete = {{"POINTRT_LAYER_TYPE", "discrete"},
                                                             {"POINTRT_LAYER_MEMORY", "discrete"}};
/// The host reads and writes the device's memory in place.
inline const std::map<std::string, std::string> kIntegrated = {{"POINTRT_LAYER_TYPE", "integrated"},
                                                               {"POINTRT_LAYER_MEMORY", "incoherent"}};

inline DeviceRequest forWindows() {
    DeviceRequest request;
    request.graphics = true;
    return request;
}

/// A window's picture of a ball in a room, and its presentation off screen.
class WindowPicture {
public:
    /// preview_s: time for a frame while the view moves; what does not fit in it is reprojected.
    WindowPicture(const SphereFile& ball, std::uint32_t samples, double preview_s = kFrame_s)
        : validated(forWindows()) {
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
        live = std::make_unique<ViewportRenderer>(validated.device, loaded->tracer, preview_s);
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

    void frame(double seconds = kFrame_s) {
        live->work(seconds);
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

} // namespace pointrt::test
