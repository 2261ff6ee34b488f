// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_opener.h"

#include <utility>

#include "format/base/error.h"
#include "runtime/session/options.h"
#include "runtime/window/edit/bake_job.h"
#include "runtime/window/edit/file_list.h"

namespace pointrt {
FileOpener::FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load)
    : jobs_(jobs), notify_(std::move(notify)), load_(std::move(load)) {}

void FileOpener::open(const SceneSource& scene) {
    jobs_.enqueue(JobKind::kLoad, [this, scene] { return load_(scene, std::exchange(first_, false)); });
}

void FileOpener::openNamed(const ScanBake& inputs) {
    if (isScene(inputs.scans.front())) return open({inputs.scans.front(), {}, false});
    bake(inputs, throwIfFailed);
}

void FileOpener::drop(const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    try {
        if (!isScene(paths.front())) return bake({paths, {}});
    } catch (const Error& error) {
        return notify_(error.what(), true);
    }
    if (paths.size() > 1) notify_("opening only the first of " + std::to_string(paths.size()) + " files", false);
    open({paths.front(), {}, false});
}

void FileOpener::bake(const ScanBake& scans, const std::function<void(const Job&)>& ended) {
    if (const auto other = jobs_.status(JobKind::kBake))
        return notify_(other->title + " is still running; bake one scan at a time", true);
    jobs_.start(JobKind::kBake, [&] {
        return startedJob<BakeJob>(
            std::make_unique<BakeJob>(scans),
            [this, scan = scans.scans.front()](BakeJob& bake) { open({bake.output(), scan, false}); }, ended);
    });
}

void FileOpener::openNeighbour(const std::string& path, int step) {
    const std::string neighbour = neighbourFile(path, step);
    if (!neighbour.empty() && neighbour != path) open({neighbour, {}, false});
}

} // namespace pointrt
