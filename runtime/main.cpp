// SPDX-License-Identifier: Apache-2.0
// pointrt-view: options -> device -> scene -> frames -> picture.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "pointrt/tool.hpp"
#include "runtime/camera.h"
#include "runtime/device.h"
#include "runtime/image_exr.h"
#include "runtime/image_png.h"
#include "runtime/options.h"
#include "runtime/output_file.h"
#include "runtime/progress.h"
#include "runtime/report.h"
#include "runtime/scene_file.h"
#include "runtime/staged_scene.h"
#include "runtime/staging.h"
#include "runtime/tonemap.h"
#include "runtime/tracer.h"

namespace {

using namespace pointrt;
using Clock = std::chrono::steady_clock;

/// What lives on the device, freed in order however the run ends.
struct Session {
    Device device;
    std::optional<StagedScene> scene;
    std::optional<Tracer> tracer;

    explicit Session(const Options& options) : device(createDevice({options.device, options.verbose})) {}
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session() {
        if (tracer) destroyTracer(device, *tracer);
        if (scene) destroyStagedScene(device, *scene);
        destroyDevice(device);
    }
};

SceneDescription describeScene(const Options& options) {
    if (isSceneFile(options.scene)) return readSceneFile(options.scene);
    SceneDescription scene;
    scene.path = options.scene;
    scene.instances.push_back({options.scene, {}, {}, {}});
    return scene;
}

Camera cameraFor(const StagedScene& scene, const RenderSettings& render) {
    const double aspect = static_cast<double>(render.width) / render.height;
    return frameCamera(render.camera, scene.bounds.lo, scene.bounds.hi, aspect);
}

void load(Session& session, SceneDescription description, const Options& options, Report& report) {
    const Clock::time_point start = Clock::now();
    session.scene = openScene(session.device, std::move(description), options.verbose);
    StagedScene& scene = *session.scene;
    const Camera camera = cameraFor(scene, options.render);
    addSurroundings(scene.description, options.render, camera, scene.bounds.lo, scene.bounds.hi);
    furnishScene(session.device, scene, options.render);
    session.tracer = createTracer(session.device, scene, options.render, camera);
    report.load_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    report.device = session.device.name;
    report.width = options.render.width;
    report.height = options.render.height;
    report.spp = options.render.spp;
    report.splats = scene.splat_count;
    report.device_bytes = scene.device_bytes + deviceBytes(*session.tracer);
}

/// Renders one frame and returns its milliseconds.
double renderTimed(Session& session, const Options& options, RayCounts& rays) {
    Progress progress(options.quiet, options.verbose);
    const Clock::time_point start = Clock::now();
    rays = renderFrame(session.device, *session.tracer, [&](double share) { progress.update(share); });
    const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    progress.finish();
    return milliseconds;
}

/// The first frame is the warm-up of a benchmark, and all there is otherwise.
void renderFrames(Session& session, const Options& options, Report& report) {
    report.frame_ms = {renderTimed(session, options, report.rays)};
    report.first_frame_seconds = secondsSinceStart();
    if (options.bench_frames == 0) return;
    report.frame_ms.clear();
    for (std::uint32_t frame = 0; frame < options.bench_frames; ++frame)
        report.frame_ms.push_back(renderTimed(session, options, report.rays));
}

void writeImage(const std::string& path, const Film& film) {
    if (path.ends_with(".exr"))
        writeExr(path, film);
    else
        writePng(path, developFilm(film));
}

void render(const Options& options) {
    for (const std::string& path : {options.output, options.stats})
        if (!path.empty() && path != "-") requireWritable(path);
    SceneDescription description = describeScene(options);
    Report report;
    Session session(options);
    load(session, std::move(description), options, report);
    renderFrames(session, options, report);
    if (!options.output.empty()) writeImage(options.output, readFilm(*session.tracer));
    const std::string json = reportJson(report);
    if (options.bench_frames != 0) writeText("-", json);
    // A benchmark has already printed it.
    if (!options.stats.empty() && !(options.bench_frames != 0 && options.stats == "-")) writeText(options.stats, json);
    if (options.verbose && !options.output.empty()) std::fprintf(stderr, "wrote %s\n", options.output.c_str());
}

int run(int argc, const char* const* argv) {
    secondsSinceStart(); // where the kernel does not tell, the clock starts here
    Options options;
    if (const std::optional<int> done = parseOptions(argc, argv, options)) return *done;
    if (options.list_devices)
        writeText("-", listDevices());
    else
        render(options);
    if (const std::uint64_t messages = validationMessages())
        throw Error{ExitCode::kCannotRun, "the validation layer had " + std::to_string(messages) + " messages"};
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-view", [&] { return run(argc, argv); });
}
