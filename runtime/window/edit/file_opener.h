// SPDX-License-Identifier: Apache-2.0
// Opens files that the user names or drops: loads scenes, bakes scans first.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/window/edit/job_queue.h"

namespace pointrt {

class FileOpener {
public:
    /// Starts loading a scene. first: true in the first call.
    using StartLoad = std::function<StartedJob(const std::string& path, bool first)>;

    /// jobs must outlive it. notify: receives errors and remarks.
    FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load);

    /// Loads a scene, instead of one that is still loading.
    void open(const std::string& path);
    /// The same for the file of the command line, which is baked first if it is a scan. Errors are thrown, from here or
    /// from JobQueue::poll, because there is nothing else to show.
    void openNamed(const std::string& path);
    /// Opens the first file if it is a scene. Otherwise all are scans, which are baked together unless they have been
    /// before.
    void drop(const std::vector<std::string>& paths);
    /// Opens the scene step files after path in its folder, if there is another one.
    void openNeighbour(const std::string& path, int step);

private:
    void bake(const std::vector<std::string>& scans, const std::function<void(const Job&)>& ended = {});

    JobQueue& jobs_;
    JobQueue::Notify notify_;
    StartLoad load_;
    bool first_ = true;
};

} // namespace pointrt
