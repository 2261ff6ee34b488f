// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/load_job.h"

#include <filesystem>

#include "runtime/session/load_request.h"
#include "runtime/session/settings.h"
#include "runtime/window/live/viewport_renderer.h"

namespace pointrt {
namespace {

std::unique_ptr<LoadedScene> load(Device& owner, Device& worker, const Options& options, double free_share,
                                  JobControl& control) {
    const LoadStage stage = [&](const char* what, double share) {
        control.throwIfCancelled();
        control.setDetail(what);
        control.setProgress(share);
    };
    stage("reading", 0);
    LoadRequest request = loadRequest(options, describeScene(options));
    request.free_share = free_share;
    request.roots_alone = true;
    request.size = TracerSize{kSliceLanes, 1}; // the first picture allocates films of the window's size
    std::unique_ptr<LoadedScene> loaded = loadScene(owner, worker, request, stage);
    control.throwIfCancelled();
    return loaded;
}

std::string titleOf(const Options& options) {
    return std::filesystem::path(options.source.empty() ? options.scene : options.source).filename().string();
}

} // namespace

LoadJob::LoadJob(Device& device, const Options& options, double free_share)
    : worker_(device), job_("Loading " + titleOf(options), [this, &device, options, free_share](JobControl& control) {
          loaded_ = load(device, worker_.get(), options, free_share, control);
      }) {}

std::unique_ptr<LoadedScene> LoadJob::take() { return job_.state() == JobState::kDone ? std::move(loaded_) : nullptr; }

SceneUpdateJob::SceneUpdateJob(Device& device, LoadedScene& loaded, const SceneDescription& description,
                               const RenderSettings& settings)
    : worker_(device), job_("Updating the scene", [this, &loaded, description, settings](JobControl& control) {
          updateScene(worker_.get(), loaded, description, settings, control);
      }) {}

} // namespace pointrt
