// SPDX-License-Identifier: Apache-2.0
// Jobs that load a scene, or update it after edits.
#pragma once

#include <memory>

#include "runtime/render/loaded_scene.h"
#include "runtime/session/options.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/scene_update.h"

namespace pointrt {

/// A worker device for a job's thread.
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

/// Loads options.scene. free_share: see LoadRequest. Start it while no other thread uses device, which must outlive the
/// job and the loaded scene.
class LoadJob {
public:
    LoadJob(Device& device, const Options& options, double free_share = 1);

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The loaded scene, once; null unless the job is done.
    std::unique_ptr<LoadedScene> take();

private:
    JobDevice worker_;
    std::unique_ptr<LoadedScene> loaded_; ///< owned by the thread until the job has ended
    Job job_;                             ///< last, so that it ends before the others are destroyed
};

/// Runs updateScene. The job has exclusive access to loaded until it has ended.
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
