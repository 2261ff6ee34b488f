// SPDX-License-Identifier: Apache-2.0
// pointrt-view: options -> baked scans -> device -> scene -> frames -> picture.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "format/base/report_file.h"
#include "format/base/require_pro.h"
#include "format/base/run_tool.h"
#include "format/os/interrupt.h"
#include "format/os/process.h"
#include "format/os/process_time.h"
#include "runtime/app/bake_inputs.h"
#include "runtime/app/camera_job.h"
#include "runtime/app/render_job.h"
#include "runtime/app/video.h"
#include "runtime/gpu/device.h"
#include "runtime/scene/turntable.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/session/options.h"
#include "runtime/session/output_check.h"
#include "runtime/session/plan_view.h"
#include "runtime/session/profile_report.h"
#include "runtime/session/render_session.h"
#include "runtime/session/report.h"
#include "runtime/session/settings.h"
#include "runtime/util/output_file.h"
#ifdef POINTRT_HAS_WINDOW
#include "runtime/window/app/window.h"
#endif

namespace {

using namespace pointrt;

void render(Options options) {
    std::optional<CameraPlan> cameras;
    if (!options.cameras.empty()) cameras = planCameras(options);
    const std::string encoder = options.video.empty() ? "" : findEncoder(options.video);
    if (!options.video.empty()) requireWritable(options.video);
    requireOutputsApart(options, {});
    if (!options.video.empty()) prepareVideo(options);
    const std::string first = options.turntable != 0 ? frameName(options.output, 0) : options.output;
    if (!first.empty() && !cameras) requireWritable(first);
    if (!options.stats.empty()) requireReportWritable(options.stats);
    if (!bakeInputs(options)) return;
    SceneDescription description = describeScene(options);
    fillPlan(options, description);
    requireOutputsApart(options, description);
    if (!isSceneOrSet(options.scene)) requirePro(options.scene);
    Report report;
    RenderSession session(options);
    loadSession(session, std::move(description), options, report);
    if (cameras)
        renderCameras(session, *cameras, options, report);
    else
        (options.turntable != 0 ? renderTurntable : renderPicture)(session, options, report);
    if (!options.video.empty() && !interrupted()) encodeVideo(options, encoder);
    printNotes(session, options);
    if (session.profile) {
        report.profile = profileJson(*session.profile);
        std::fputs(profileTable(*session.profile).c_str(), stderr);
    }
    const std::string json = reportJson(report);
    if (options.bench_frames != 0) writeReport("-", json);
    // a benchmark has already printed its report
    if (!options.stats.empty() && !(options.bench_frames != 0 && options.stats == "-"))
        writeReport(options.stats, json);
}

/// A device that hung or whose driver was updated may work on a second attempt.
void renderOnceMoreIfLost(const Options& options) {
    try {
        return render(options);
    } catch (const DeviceLost& lost) {
        std::fprintf(stderr, "pointrt-view: warning: %s; rendering again from the start\n", lost.what());
    }
    render(options);
}

void showWindow(const Options& options) {
    requireOutputsApart(options, {});
    if (!options.stats.empty()) requireReportWritable(options.stats);
    std::error_code failure;
    for (const std::string& input : options.inputs)
        if (std::filesystem::status(input, failure).type() == std::filesystem::file_type::not_found)
            throw Error{ExitCode::kBadInput, input + ": No such file or directory"};
#ifdef POINTRT_HAS_WINDOW
    runWindow(options);
#else
    throw Error{ExitCode::kBadUsage, "this build has no window; render to a file with -o FILE.png or -o FILE.exr"};
#endif
}

int run(int argc, const char* const* argv) {
    keepWorkingWithoutReaders();
    secondsSinceStart(); // starts the clock on systems without /proc
    Options options;
    if (const std::optional<int> done = parseOptions(argc, argv, options)) return *done;
    if (options.list_devices)
        writeReport("-", listDevices());
    else if (opensWindow(options))
        showWindow(options);
    else
        renderOnceMoreIfLost(options);
    if (const std::uint64_t messages = validationMessages())
        throw Error{ExitCode::kCannotRun,
                    "the Vulkan validation layer reported " + std::to_string(messages) + " messages"};
    raiseInterrupt();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-view", [&] { return run(argc, argv); });
}
