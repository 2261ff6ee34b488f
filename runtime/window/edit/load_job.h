// SPDX-License-Identifier: Apache-2.0
// Loading and refurnishing a scene behind the window.
#pragma once

#include <memory>

#include "runtime/render/loaded_scene.h"
#include "runtime/session/options.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/scene_update.h"

namespace pointrt {

/// A device for one job's thread.
class JobDevice {
public:
    explicit JobDevice(Device& owner) : device_(workerDevice(owner)) {}
    ~JobDevice() { destroyWorkerDevice(device_); }
    JobDevice(const JobDevice&) = delete;
    JobDevice& operator=(const JobDevice&) = delete;
    Device& get() { return device_; }

private:
    Device device_;
};

/// Loads options.scene. free_share: LoadRequest's. To be started where no other thread uses device, which must outlive
/// it and what it has loaded.
class LoadJob {
public:
    LoadJob(Device& device, const Options& options, double free_share = 1);

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// What it has loaded, once; null unless it is done.
    std::unique_ptr<LoadedScene> take();

private:
    JobDevice worker_;
    std::unique_ptr<LoadedScene> loaded_; ///< the thread's until the job has ended
    Job job_;                             ///< last: ends before the others go
};

/// Furnishes loaded anew: see refurnish. loaded is the job's alone until it has ended.
class SceneUpdateJob {
public:
    SceneUpdateJob(Device& device, LoadedScene& loaded, const SceneDescription& description,
                   const RenderSettings& settings);

    Job& job() { return job_; }
    const Job& job() const { return job_; }

private:
    JobDevice worker_;
    Job job_;
};

} // namespace pointrt
