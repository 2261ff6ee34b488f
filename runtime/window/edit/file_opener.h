// SPDX-License-Identifier: Apache-2.0
// What becomes of files that the user opens or drops: scenes are loaded, scans are baked first.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/window/edit/job_queue.h"

namespace pointrt {

class FileOpener {
public:
    /// Begins to load a scene. first: none was begun before.
    using StartLoad = std::function<StartedJob(const std::string& path, bool first)>;

    /// jobs must outlive it. tell: to whom it reports what it has not done, and why.
    FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load);

    /// Loads a scene in place of what is being loaded.
    void open(const std::string& path);
    /// Does the same with what the command line names, or bakes it first where it is a scan. Where that fails, Error is
    /// thrown, from here or from JobQueue::poll: there is nothing else to show.
    void openNamed(const std::string& path);
    /// Opens the first where it is a scene; else all are scans, which are baked together unless they have been.
    void drop(const std::vector<std::string>& paths);
    /// Opens the scene step files after path in its folder, where there is another one.
    void openNeighbour(const std::string& path, int step);

private:
    void bake(const std::vector<std::string>& scans, const std::function<void(const Job&)>& ended = {});

    JobQueue& jobs_;
    JobQueue::Notify notify_;
    StartLoad load_;
    bool first_ = true;
};

} // namespace pointrt
