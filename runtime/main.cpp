// SPDX-License-Identifier: Apache-2.0
// pointrt-view: options -> device -> scene -> frames -> picture.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "pointrt/tool.hpp"
#include "runtime/camera.h"
#include "runtime/denoiser.h"
#include "runtime/device.h"
#include "runtime/film_file.h"
#include "runtime/film_resume.h"
#include "runtime/film_signature.h"
#include "runtime/image_png.h"
#include "runtime/interrupt.h"
#include "runtime/option_values.h"
#include "runtime/options.h"
#include "runtime/output_file.h"
#include "runtime/progress.h"
#include "runtime/report.h"
#include "runtime/settings.h"
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
    RenderSettings settings;
    Camera camera;

    explicit Session(const Options& options) : device(createDevice({options.device, options.verbose})) {}
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session() {
        if (tracer) destroyTracer(device, *tracer);
        if (scene) destroyStagedScene(device, *scene);
        destroyDevice(device);
    }
};

void load(Session& session, SceneDescription description, const Options& options, Report& report) {
    const Clock::time_point start = Clock::now();
    session.settings = resolveSettings(options, description);
    RenderSettings& settings = session.settings;
    session.scene = openScene(session.device, std::move(description), options.verbose);
    StagedScene& scene = *session.scene;
    session.camera = frameCamera(settings.camera, scene.bounds.lo, scene.bounds.hi,
                                 static_cast<double>(settings.width) / settings.height);
    addSurroundings(scene.description, settings, session.camera, scene.bounds.lo, scene.bounds.hi);
    furnishScene(session.device, scene, settings);
    // the denoiser is guided by first hits; where the samples may end early, it may be wanted in the end
    const std::uint32_t fewest = options.limits.seconds || options.limits.noise ? 1 : settings.spp;
    settings.first_hits |= wantsDenoising(options, settings, scene.description, fewest);
    session.tracer = createTracer(session.device, scene, settings, session.camera);
    report.load_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    report.device = session.device.name;
    report.integrator = nameOf(kIntegratorNames, settings.integrator);
    report.width = settings.width;
    report.height = settings.height;
    report.spp = settings.spp;
    report.splats = scene.splat_count;
    report.device_bytes = scene.device_bytes + deviceBytes(*session.tracer);
}

std::string detailOf(const FrameState& state) {
    char noise[32] = "";
    if (state.noise) std::snprintf(noise, sizeof noise, ", noise %.4f", *state.noise);
    return std::to_string(static_cast<std::uint32_t>(state.mean)) + " samples" + noise;
}

/// Renders one frame, from start on if there is one.
FrameState renderTimed(Session& session, const Options& options, const Film* start, Report& report) {
    Progress progress(options.quiet, options.verbose);
    FrameJob job;
    job.samples = session.settings.spp;
    job.limits = options.limits;
    job.progress = [&](const FrameState& state, double share) { progress.update(share, detailOf(state)); };
    if (options.output.ends_with(".exr")) job.interrupted = interrupted;
    report.rays = {};
    const Clock::time_point begin = Clock::now();
    const FrameState state = renderUntil(session.device, *session.tracer, job, start, report.rays);
    report.frame_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    progress.finish();
    return state;
}

/// The first frame is the warm-up of a benchmark, and all there is otherwise.
FrameState renderFrames(Session& session, const Options& options, const Film* start, Report& report) {
    FrameState state = renderTimed(session, options, start, report);
    report.first_frame_seconds = secondsSinceStart();
    if (options.bench_frames != 0) report.frame_ms.clear();
    for (std::uint32_t frame = 0; frame < options.bench_frames && !interrupted(); ++frame)
        state = renderTimed(session, options, nullptr, report);
    return state;
}

/// The denoiser keeps to what the scene covers, but a backdrop outside it has shadows as noisy as any.
void denoiseAll(Device& device, Film& film) {
    const std::vector<float> covered = film.rgba;
    for (std::size_t i = 3; i < film.rgba.size(); i += 4)
        if (film.rgba[i] == 0) film.rgba[i] = 1;
    denoiseFilm(device, film);
    for (std::size_t i = 3; i < film.rgba.size(); i += 4) film.rgba[i] = covered[i];
}

void denoise(Session& session, const Options& options, Film& film, Report& report) {
    if (!wantsDenoising(options, session.settings, session.scene->description, report.samples)) return;
    const Clock::time_point start = Clock::now();
    denoiseAll(session.device, film);
    report.denoise_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void writeImage(const Session& session, const Options& options, const std::string& signature, Film film) {
    if (options.output.ends_with(".png"))
        return writePng(options.output, developFilm(film, options.exposure.value_or(0)));
    const std::uint32_t samples = mostSamples(film);
    writeSavedFilm(options.output, {std::move(film), samples, session.settings.seed, signature});
}

/// What is not in the picture, for people.
void tellEnd(const Options& options, const Session& session, const FrameState& state, const Report& report) {
    const char* path = options.output.c_str();
    if (interrupted())
        std::fprintf(stderr, "pointrt-view: %s: interrupted at %u of %u samples; --resume goes on\n", path,
                     state.samples, session.settings.spp);
    else if (state.traced == 0 && !options.quiet)
        std::fprintf(stderr, "pointrt-view: %s: nothing to do, it has %u samples\n", path, state.samples);
    if (options.verbose && state.traced > 0)
        std::fprintf(stderr, "%u samples, noise %.4f; denoised in %.0f ms; wrote %s\n", report.samples, report.noise,
                     report.denoise_ms, path);
}

void renderPicture(Session& session, const Options& options, Report& report) {
    std::string signature;
    std::optional<Film> start;
    if (options.output.ends_with(".exr")) {
        signature = filmSignature(*session.scene, session.settings, session.camera);
        if (options.resume) start = filmToResume(options.output, signature, session.settings);
        noteInterrupts();
    }
    const FrameState state = renderFrames(session, options, start ? &*start : nullptr, report);
    Film film = readFilm(*session.tracer);
    report.samples = state.samples;
    report.noise = relativeNoise(film);
    denoise(session, options, film, report);
    if (options.output.empty()) return;
    if (state.traced > 0 || (start && options.denoise == DenoiseChoice::kOn))
        writeImage(session, options, signature, std::move(film));
    tellEnd(options, session, state, report);
}

void render(const Options& options) {
    for (const std::string& path : {options.output, options.stats})
        if (!path.empty() && path != "-") requireWritable(path);
    SceneDescription description = describeScene(options);
    Report report;
    Session session(options);
    load(session, std::move(description), options, report);
    renderPicture(session, options, report);
    const std::string json = reportJson(report);
    if (options.bench_frames != 0) writeText("-", json);
    // A benchmark has already printed it.
    if (!options.stats.empty() && !(options.bench_frames != 0 && options.stats == "-")) writeText(options.stats, json);
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
    passInterruptOn();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-view", [&] { return run(argc, argv); });
}
