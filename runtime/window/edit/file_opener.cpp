// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_opener.h"

#include <utility>

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/window/edit/bake_job.h"
#include "runtime/window/edit/file_list.h"

namespace pointrt {
namespace {

bool isScene(const std::string& path) { return path.ends_with(".pro") || isSceneOrSet(path) || beginsAsPro(path); }

} // namespace

FileOpener::FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load)
    : jobs_(jobs), notify_(std::move(notify)), load_(std::move(load)) {}

void FileOpener::open(const std::string& path) {
    jobs_.enqueue(JobKind::kLoad, [this, path] { return load_(path, std::exchange(first_, false)); });
}

void FileOpener::openNamed(const std::string& path) {
    if (isScene(path)) return open(path);
    bake({path}, throwIfFailed);
}

void FileOpener::drop(const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    try {
        if (!isScene(paths.front())) return bake(paths);
    } catch (const Error& error) {
        return notify_(error.what(), true);
    }
    if (paths.size() > 1) notify_("opening only the first of " + std::to_string(paths.size()) + " files", false);
    open(paths.front());
}

void FileOpener::bake(const std::vector<std::string>& scans, const std::function<void(const Job&)>& ended) {
    if (const auto other = jobs_.status(JobKind::kBake))
        return notify_(other->title + " is still running; bake one scan at a time", true);
    const BakePlan plan = planBake(scans);
    if (plan.is_up_to_date) return open(plan.output);
    jobs_.start(JobKind::kBake, [&] {
        return startedJob<BakeJob>(
            std::make_unique<BakeJob>(plan), [this](BakeJob& bake) { open(bake.output()); }, ended);
    });
}

void FileOpener::openNeighbour(const std::string& path, int step) {
    const std::string neighbour = neighbourFile(path, step);
    if (!neighbour.empty() && neighbour != path) open(neighbour);
}

} // namespace pointrt
