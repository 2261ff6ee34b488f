// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_opener.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "format/base/error.h"
#include "runtime/session/options.h"
#include "runtime/window/edit/bake_job.h"
#include "runtime/window/edit/file_list.h"

namespace pointrt {
namespace {

/// Reports mistakes before a job starts.
void requireScans(const ScanBake& scans) {
    std::error_code failure;
    for (const std::string& scan : scans.scans)
        if (std::filesystem::status(scan, failure).type() == std::filesystem::file_type::not_found)
            throw Error{ExitCode::kBadInput, scan + ": No such file or directory"};
}

} // namespace

FileOpener::FileOpener(JobQueue& jobs, JobQueue::Notify notify, StartLoad load)
    : jobs_(jobs), notify_(std::move(notify)), load_(std::move(load)) {}

void FileOpener::open(const SceneSource& scene) {
    current_ = scene.name();
    jobs_.enqueue(JobKind::kLoad, [this, scene] { return load_(scene, std::exchange(first_, false)); });
}

void FileOpener::openNamed(const ScanBake& inputs) {
    first_ = true;
    if (!isScene(inputs.scans.front())) return bake(inputs);
    openBaked(inputs.scans);
}

void FileOpener::drop(const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    try {
        if (!isScene(paths.front())) return bake({paths, {}});
    } catch (const Error& error) {
        return notify_(error.what(), true);
    }
    if (areBakedScans(paths)) return openBaked(paths);
    if (paths.size() > 1) notify_("opening only the first of " + std::to_string(paths.size()) + " files", false);
    open({paths.front(), {}, false});
}

void FileOpener::openBaked(const std::vector<std::string>& paths) {
    SceneSource scene{paths.front(), {}, false};
    scene.added.assign(paths.begin() + 1, paths.end());
    open(scene);
}

void FileOpener::bake(const ScanBake& scans) {
    if (const auto other = jobs_.status(JobKind::kBake))
        return notify_(other->title + " is still running; bake one scan at a time", true);
    requireScans(scans);
    baked_ = scans;
    jobs_.start(JobKind::kBake, [&] {
        auto quick = std::make_unique<BakeJob>(scans, BakeDetail::kQuick);
        const BakeJob* job = quick.get();
        StartedJob started = startedJob<BakeJob>(std::move(quick), [this, scans](BakeJob& bake) {
            open({bake.output(), scans.scans.front(), false, bake.isQuick()});
        });
        started.ended = [this, scans, job](const Job& end) {
            if (end.state() == JobState::kFailed || (end.state() == JobState::kDone && job->isQuick()))
                bakeFully(scans, end.state() == JobState::kDone);
        };
        started.fails_silently = true; // the full bake will report the reason
        return started;
    });
}

void FileOpener::bakeAgain(const std::string& splat_kind) {
    constexpr const char* kOption = "--splat";
    ScanBake again = baked_.value();
    const auto given = std::find(again.options.begin(), again.options.end(), kOption);
    if (given != again.options.end()) again.options.erase(given, std::min(given + 2, again.options.end()));
    again.options.insert(again.options.end(), {kOption, splat_kind});
    bake(again);
}

void FileOpener::bakeFully(const ScanBake& scans, bool follows_quick) {
    jobs_.enqueue(JobKind::kBake, [this, scans, follows_quick] {
        return startedJob<BakeJob>(
            std::make_unique<BakeJob>(scans),
            [this, scan = scans.scans.front(), follows_quick](BakeJob& bake) {
                if (follows_quick && current_ != scan)
                    return notify_("baked " + scan + "; open it again to see it", false);
                open({bake.output(), scan, false, false, follows_quick});
            },
            [this](const Job& end) {
                if (first_) throwIfFailed(end);
            });
    });
}

void FileOpener::openNeighbour(const std::string& path, int step) {
    const std::string neighbour = neighbourFile(path, step);
    if (!neighbour.empty() && neighbour != path) open({neighbour, {}, false});
}

} // namespace pointrt
