// SPDX-License-Identifier: Apache-2.0
// Opens files that the user names or drops: loads scenes, bakes scans first.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/session/bake_key.h"
#include "runtime/window/edit/job_queue.h"

namespace pointrt {

/// A scene to load.
struct SceneSource {
    std::string path;
    std::string source;         ///< the name by which users know path, such as the scan it was baked from; empty: path
    bool is_autosave = false;   ///< path is an autosave: it has edits of source that the user has not saved
    bool is_quick = false;      ///< path is a quick bake of source
    bool follows_quick = false; ///< path is the full bake that follows a quick one
    std::vector<std::string> added = {}; ///< further scans (.pro, .proset) to show together with path
    bool only_view = false;              ///< an autosave that differs from source only in the view

    const std::string& name() const { return source.empty() ? path : source; }
};

class FileOpener {
public:
    /// Starts loading a scene. first: it is the scene of the command line.
    using StartLoad = std::function<StartedJob(const SceneSource& scene, bool first)>;

    /// jobs must outlive it. notify: receives errors and remarks.
    FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load);

    /// Loads a scene. Cancels one that is still loading.
    void open(const SceneSource& scene);
    /// The same for the scene of the command line, or for its scans, which are baked first: quickly, to have something
    /// to show, then fully. While nothing else is shown, errors are thrown, from here or from JobQueue::poll.
    void openNamed(const ScanBake& inputs);
    /// Opens baked scans together, each as a layer, or a single scene file. Bakes other files together, as scans.
    void drop(const std::vector<std::string>& paths);
    /// Whether the scene of this name was baked from scans that can be baked again.
    bool mayBakeAgain(const std::string& name) const { return baked_ && baked_->scans.front() == name; }
    /// Bakes the scans of the last bake with another kind of splats, --splat auto, disc or ball, and opens them.
    void bakeAgain(const std::string& splat_kind);
    /// Opens the scene step files after path in its folder, if there is another one.
    void openNeighbour(const std::string& path, int step);

private:
    void openBaked(const std::vector<std::string>& paths);
    void bake(const ScanBake& scans);
    void bakeFully(const ScanBake& scans, bool follows_quick);

    JobQueue& jobs_;
    JobQueue::Notify notify_;
    StartLoad load_;
    std::optional<ScanBake> baked_; ///< the last scans that were baked
    std::string current_;           ///< name of the last scene opened
    bool first_ = false;
};

} // namespace pointrt
