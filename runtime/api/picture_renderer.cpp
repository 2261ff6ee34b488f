// SPDX-License-Identifier: Apache-2.0
#include <mutex>
#include <utility>

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "pointrt/render.hpp"
#include "runtime/api/picture_camera.h"
#include "runtime/api/picture_layers.h"
#include "runtime/api/picture_settings.h"
#include "runtime/api/setting_names.h"
#include "runtime/cast/trace_device.h"
#include "runtime/cast/translated.h"
#include "runtime/render/camera_series.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/session/load_request.h"
#include "runtime/session/settings.h"

namespace pointrt {
namespace {

SceneDescription describe(const std::vector<std::string>& paths, PictureOptions& picture) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "a scene needs at least one file");
    for (const std::string& path : paths) {
        if (isSceneFile(path) && paths.size() > 1)
            throw Error(ExitCode::kBadUsage, path + ": a scene file cannot be combined with other files");
        if (!isSceneOrSet(path)) requirePro(path);
    }
    picture.options.scene = paths.front();
    SceneDescription scene = describeScene(picture.options);
    for (std::size_t i = 1; i < paths.size(); ++i) scene.instances.push_back({paths[i], {}, {}, {}});
    if (picture.staged_for) scene.staged_for = picture.staged_for;
    return scene;
}

LoadRequest requestFor(const std::vector<std::string>& paths, const PictureSettings& settings) {
    PictureOptions picture = pictureOptions(settings);
    SceneDescription scene = describe(paths, picture);
    return loadRequest(picture.options, std::move(scene));
}

PixelSize sizeOf(std::uint32_t width, std::uint32_t height) {
    for (const std::uint32_t side : {width, height})
        if (side < 1 || side > kMaxPixelSide)
            throw Error(ExitCode::kBadUsage, "the picture's width and height must be 1 to " +
                                                 std::to_string(kMaxPixelSide) + " pixels each, not " +
                                                 std::to_string(width) + " x " + std::to_string(height));
    return {width, height};
}

} // namespace

struct PictureRenderer::State {
    State(std::shared_ptr<TraceDevice::State> on, LoadRequest what)
        : owner(std::move(on)), device(workerDevice(owner->device)), request(std::move(what)) {
        try {
            loaded = loadScene(device, device, request, LoadStage{});
            series.emplace(device, *loaded, request.memory);
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~State() { destroy(); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    Picture render(const PictureCamera& camera, PixelSize size, const std::vector<std::string>& layers,
                   const std::function<bool()>& give_up) {
        const std::lock_guard turn(mutex);
        const bool filtered = loaded->settings.denoise == DenoiseChoice::kOn; // which needs first hits
        const bool first_hits = wantsFirstHits(layers) || filtered;
        const SeriesShot shot{sceneCamera(camera, *loaded, request, size), size, first_hits, true};
        FrameJob job;
        job.samples = loaded->settings.spp;
        // set even without give_up: bands are then rendered in turn, as for files, and keep their light components
        job.interrupted = [&] { return given_up = given_up || (give_up && give_up()); };
        given_up = false;
        Film film = series->render(shot, job);
        if (given_up) throw Error(ExitCode::kCannotRun, "rendering was cancelled");
        if (filtered) denoisePicture(device, film);
        return pictureOf(std::move(film), layers);
    }

    std::shared_ptr<TraceDevice::State> owner;
    Device device; ///< a worker of the owner's device
    LoadRequest request;
    std::unique_ptr<LoadedScene> loaded;
    std::optional<CameraSeries> series;
    std::mutex mutex;
    bool given_up = false;

private:
    void destroy() {
        series.reset();
        loaded.reset();
        destroyWorkerDevice(device);
    }
};

PictureRenderer::PictureRenderer(const TraceDevice& device, const std::vector<std::string>& paths,
                                 const PictureSettings& settings)
    : state_(translated([&] {
          return namingSettings([&] { return std::make_unique<State>(device.state_, requestFor(paths, settings)); });
      })) {}
PictureRenderer::~PictureRenderer() = default;
PictureRenderer::PictureRenderer(PictureRenderer&&) noexcept = default;
PictureRenderer& PictureRenderer::operator=(PictureRenderer&&) noexcept = default;

Picture PictureRenderer::render(const PictureCamera& camera, std::uint32_t width, std::uint32_t height,
                                const std::vector<std::string>& layers, const std::function<bool()>& give_up) {
    return translated([&] { return state_->render(camera, sizeOf(width, height), layers, give_up); });
}

} // namespace pointrt
