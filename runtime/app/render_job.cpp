// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/render_job.h"

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/film/denoiser.h"
#include "runtime/film/film_file.h"
#include "runtime/film/film_resume.h"
#include "runtime/film/film_signature.h"
#include "runtime/image/image_png.h"
#include "runtime/image/tonemap.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/turntable.h"
#include "runtime/session/settings.h"
#include "runtime/util/interrupt.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;
using ShowProgress = std::function<void(const FrameState&, double share)>;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string detailOf(const FrameState& state) {
    char noise[32] = "";
    if (state.noise) std::snprintf(noise, sizeof noise, ", noise %.4f", *state.noise);
    return std::to_string(static_cast<std::uint32_t>(state.mean)) + " samples" + noise;
}

RenderPlan planOf(const RenderSession& session) {
    const RenderSettings& settings = session.settings;
    return {settings, session.camera, tilingFor(session.device, settings.width, settings.height)};
}

/// Renders one frame, from start on if there is one.
FrameState renderTimed(RenderSession& session, const Options& options, const Film* start, const ShowProgress& show,
                       Report& report) {
    FrameJob job;
    job.samples = session.settings.spp;
    job.limits = options.limits;
    job.progress = show;
    if (options.output.ends_with(".exr") || options.turntable != 0) job.interrupted = interrupted;
    const Clock::time_point begin = Clock::now();
    session.renderer->begin(planOf(session), job, start);
    const FrameState state = session.renderer->run();
    report.frame_ms.push_back(millisecondsSince(begin));
    report.rays = session.renderer->takeRays();
    return state;
}

FrameState renderShown(RenderSession& session, const Options& options, const Film* start, Report& report) {
    RenderProgress progress(options.quiet, options.verbose, options.progress_lines);
    const ShowProgress show = [&](const FrameState& state, double share) { progress.update(share, detailOf(state)); };
    const FrameState state = renderTimed(session, options, start, show, report);
    progress.finish();
    return state;
}

/// The first frame is the warm-up of a benchmark, and all there is otherwise.
FrameState renderFrames(RenderSession& session, const Options& options, const Film* start, Report& report) {
    FrameState state = renderShown(session, options, start, report);
    report.first_frame_seconds = secondsSinceStart();
    if (options.bench_frames != 0) report.frame_ms.clear();
    for (std::uint32_t frame = 0; frame < options.bench_frames && !interrupted(); ++frame)
        state = renderShown(session, options, nullptr, report);
    return state;
}

/// The picture of the frame that has ended as state, with the filter where it is wanted.
Film finishFilm(RenderSession& session, Film film, const Options& options, const FrameState& state, Report& report) {
    report.samples = state.samples;
    report.noise = relativeNoise(film);
    if (!wantsDenoising(options, session.settings, session.loaded->scene.description, report.samples)) return film;
    const Clock::time_point start = Clock::now();
    denoisePicture(session.device, film);
    report.denoise_ms = millisecondsSince(start);
    return film;
}

void writeImage(const RenderSession& session, const std::string& path, const std::string& signature, Film film) {
    if (path.ends_with(".png")) return writePng(path, tonemapFilm(film, session.settings.exposure));
    const std::uint32_t samples = mostSamples(film);
    writeSavedFilm(path, {std::move(film), samples, session.settings.seed, signature});
}

/// What is not in the picture, for people.
void tellEnd(const Options& options, const RenderSession& session, const FrameState& state, const Report& report) {
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

std::string signatureFor(const RenderSession& session, const std::string& path) {
    return path.ends_with(".exr") ? filmSignature(session.loaded->scene, session.settings, session.camera) : "";
}

/// False where it was interrupted: nothing is written then.
bool renderTurn(RenderSession& session, const Options& options, std::uint32_t turn, RenderProgress& progress,
                Report& report) {
    const std::string path = frameName(options.output, turn);
    const std::string place = "picture " + std::to_string(turn + 1) + " of " + std::to_string(options.turntable) + ", ";
    const ShowProgress show = [&](const FrameState& state, double share) {
        progress.update((turn + share) / options.turntable, place + detailOf(state));
    };
    const FrameState state = renderTimed(session, options, nullptr, show, report);
    if (turn == 0) report.first_frame_seconds = secondsSinceStart();
    Film film = finishFilm(session, session.renderer->takeFilm(), options, state, report);
    if (interrupted()) return false;
    writeImage(session, path, signatureFor(session, path), std::move(film));
    return true;
}

} // namespace

void renderPicture(RenderSession& session, const Options& options, Report& report) {
    std::optional<Film> start;
    const std::string signature = signatureFor(session, options.output);
    if (options.output.ends_with(".exr")) {
        if (options.resume) start = filmToResume(options.output, signature, session.settings);
        noteInterrupts();
    }
    const FrameState state = renderFrames(session, options, start ? &*start : nullptr, report);
    Film film = session.renderer->takeFilm();
    dropRenderer(session);
    film = finishFilm(session, std::move(film), options, state, report);
    if (options.output.empty()) return;
    if (state.traced > 0 || (start && session.settings.denoise == DenoiseChoice::kOn))
        writeImage(session, options.output, signature, std::move(film));
    tellEnd(options, session, state, report);
}

void renderTurntable(RenderSession& session, const Options& options, Report& report) {
    const DeviceScene& scene = session.loaded->scene;
    const Vec3 center = 0.5 * (scene.bounds.lo + scene.bounds.hi);
    const TurntableAxis axis{session.settings.camera.target.value_or(center),
                             sceneUp(scene.description, session.settings)};
    const Camera first = session.camera;
    noteInterrupts();
    RenderProgress progress(options.quiet, options.verbose, options.progress_lines);
    std::uint32_t turn = 0;
    for (; turn < options.turntable; ++turn) {
        session.camera = turntableCamera(first, axis, turn, options.turntable);
        if (!renderTurn(session, options, turn, progress, report)) break;
    }
    progress.finish();
    if (turn < options.turntable)
        std::fprintf(stderr, "pointrt-view: %s: interrupted, %u of %u pictures are written\n", options.output.c_str(),
                     turn, options.turntable);
    else if (options.verbose)
        std::fprintf(stderr, "wrote %u pictures, the last %s\n", turn, frameName(options.output, turn - 1).c_str());
}

} // namespace pointrt
