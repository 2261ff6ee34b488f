// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/turntable_job.h"

#include <filesystem>

#include "format/base/error.h"
#include "runtime/scene/turntable.h"
#include "runtime/session/options.h"
#include "runtime/session/tool_run.h"
#include "runtime/window/edit/viewer_run.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

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
               runViewer(scene, {movingOption(follows_views), std::to_string(pictures), "-o", safeArgument(path)},
                         device, control);
           }) {}

} // namespace pointrt
