// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/turntable_job.h"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "format/base/error.h"
#include "format/os/program.h"
#include "format/os/temporary_folder.h"
#include "runtime/scene/turntable.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/session/options.h"
#include "runtime/session/tool_run.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// A scene file in a temporary folder, deleted by the destructor.
class TemporarySceneFile {
public:
    explicit TemporarySceneFile(const SceneDescription& scene) {
        folder_ = makeTemporaryFolder();
        if (folder_.empty())
            throw Error{ExitCode::kCannotWrite,
                        fs::temp_directory_path().string() + ": cannot create a temporary folder"};
        writeSceneFile(path(), scene);
    }
    ~TemporarySceneFile() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    TemporarySceneFile(const TemporarySceneFile&) = delete;
    TemporarySceneFile& operator=(const TemporarySceneFile&) = delete;
    std::string path() const { return (folder_ / "turntable.toml").string(); }

private:
    fs::path folder_;
};

/// Parses "progress SHARE DETAIL" of pointrt-view --progress lines.
bool parseProgress(const std::string& line, JobControl& control) {
    double share = 0;
    int detail = 0;
    if (std::sscanf(line.c_str(), "progress %lf %n", &share, &detail) != 1 || detail == 0) return false;
    control.setProgress(share);
    control.setDetail(line.substr(static_cast<std::size_t>(detail)));
    return true;
}

void render(const SceneDescription& scene, const std::string& pattern, std::uint32_t pictures, const char* option,
            const std::string& device, JobControl& control) {
    const TemporarySceneFile file(scene);
    std::vector<std::string> arguments{programPath(), file.path(), option, std::to_string(pictures),
                                       "--progress",  "lines",     "-o",   safeArgument(pattern)};
    if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
    const ToolResult end = runTool(
        arguments, "pointrt-view", [&] { return control.cancelled(); },
        [&](const std::string& line) { return parseProgress(line, control); });
    if (control.cancelled()) throw JobCancelled{};
    if (end.wait_status != 0) throw Error{ExitCode::kCannotRun, describeFailure(end, "pointrt-view")};
}

std::string makeFolder(const std::string& pattern, const char* option) {
    if (!isVideo(pattern)) requireFrameNames(pattern, option);
    const fs::path folder = fs::path(pattern).parent_path();
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) throw Error{ExitCode::kCannotWrite, folder.string() + ": " + error.message()};
    return pattern;
}

} // namespace

TurntableJob::TurntableJob(const SceneDescription& scene, const std::string& pattern, std::uint32_t pictures,
                           bool follows_views, const std::string& device)
    : job_(std::string(follows_views ? "Path of " : "Turntable of ") + std::to_string(pictures) + " pictures",
           [=, path = makeFolder(pattern, movingOption(follows_views))](JobControl& control) {
               render(scene, path, pictures, movingOption(follows_views), device, control);
           }) {}

} // namespace pointrt
