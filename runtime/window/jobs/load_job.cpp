// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/jobs/load_job.h"

#include <filesystem>

namespace pointrt {

LoadJob::LoadJob(Device& device, const Options& options)
    : worker_(device), job_("Loading " + std::filesystem::path(options.scene).filename().string(),
                            [this, &device, options](JobControl& control) {
                                loaded_ = loadFromFile(device, worker_.get(), options, control);
                            }) {}

std::unique_ptr<LoadedScene> LoadJob::take() { return job_.state() == JobState::kDone ? std::move(loaded_) : nullptr; }

RefurnishJob::RefurnishJob(Device& device, LoadedScene& loaded, const SceneDescription& description,
                           const RenderSettings& settings)
    : worker_(device), job_("Relighting", [this, &loaded, description, settings](JobControl& control) {
          refurnish(worker_.get(), loaded, description, settings, control);
      }) {}

} // namespace pointrt
