// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/render_job.h"
#include "format/os/process_time.h"

#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "format/os/interrupt.h"
#include "runtime/app/picture_memory.h"
#include "runtime/app/png_picture.h"
#include "runtime/render/film_file.h"
#include "runtime/render/film_resume.h"
#include "runtime/render/film_signature.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/legend_picture.h"
#include "runtime/scene/measure_picture.h"
#include "runtime/scene/turntable.h"
#include "runtime/session/settings.h"
#include "runtime/util/clock.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

std::string detailOf(const FrameState& state) {
    char noise[32] = "";
    if (state.noise) std::snprintf(noise, sizeof noise, ", noise %.4f", *state.noise);
    return std::to_string(static_cast<std::uint32_t>(state.mean)) + " samples" + noise;
}

RenderPlan planOf(const RenderSession& session) {
    const RenderSettings& settings = session.settings;
    return {settings, session.camera, tilingFor(session.device, settings.width, settings.height)};
}

/// The job of one frame. Pictures that cannot be resumed are rendered band by band, with the same samples whether or
/// not they can be interrupted.
FrameJob jobOf(const RenderSession& session, const Options& options) {
    FrameJob job;
    job.samples = session.settings.spp;
    job.limits = options.limits;
    job.band_by_band = writesToneMapped(options) && options.turntable == 0;
    if (!options.output.empty()) job.interrupted = interrupted;
    return job;
}

/// Renders one frame, continuing start if given.
FrameState renderTimed(RenderSession& session, const FrameJob& job, std::optional<Film> start, Report& report) {
    const Clock::time_point begin = Clock::now();
    const std::clock_t cpu = std::clock();
    session.renderer->begin(planOf(session), job, std::move(start));
    const FrameState state = session.renderer->run();
    report.frame_ms.push_back(millisecondsSince(begin));
    report.frame_cpu_ms.push_back(1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    if (session.profile) {
        session.profile->frames_ms += report.frame_ms.back();
        ++session.profile->frames;
    }
    report.rays = session.renderer->takeRays();
    return state;
}

FrameState renderShown(RenderSession& session, const Options& options, FrameJob job, std::optional<Film> start,
                       Report& report) {
    RenderProgress progress(options.quiet, options.verbose, options.progress_lines);
    job.progress = [&](const FrameState& state, double share) { progress.update(share, detailOf(state)); };
    const FrameState state = renderTimed(session, job, std::move(start), report);
    progress.finish();
    reportCutRays(options.output, report.rays);
    return state;
}

/// Renders the picture; for a benchmark this frame is the warm-up, and the measured frames follow.
FrameState renderFrames(RenderSession& session, const Options& options, std::optional<Film> start, Report& report) {
    const FrameJob job = jobOf(session, options);
    FrameState state = renderShown(session, options, job, std::move(start), report);
    report.first_frame_seconds = secondsSinceStart();
    if (options.bench_frames != 0) {
        report.frame_ms.clear();
        report.frame_cpu_ms.clear();
        if (session.profile) clearProfile(*session.profile);
    }
    for (std::uint32_t frame = 0; frame < options.bench_frames && !interrupted(); ++frame)
        state = renderShown(session, options, job, {}, report);
    return state;
}

ToneMapping toneMappingOf(const RenderSession& session) {
    return toneMapping(session.loaded->scene.description, session.settings.exposure);
}

/// The finished film of a frame that ended in state, denoised if requested.
Film finishFilm(RenderSession& session, Film film, const Options& options, const FrameState& state, Report& report) {
    report.samples = state.samples;
    report.noise = relativeNoise(film);
    if (!wantsDenoising(session, options, report.samples)) return film;
    const Clock::time_point start = Clock::now();
    (toneMappingOf(session).has_alpha ? denoiseFilm : denoisePicture)(session.device, film, session.camera.panorama);
    report.denoise_ms = millisecondsSince(start);
    return film;
}

/// The legend and the measurements to draw.
PictureOverlay overlayOf(const RenderSession& session) {
    const LoadedScene& loaded = *session.loaded;
    const PixelSize size{session.settings.width, session.settings.height};
    PictureOverlay overlay;
    if (session.settings.legend.value_or(false) && loaded.scene.paint.legend)
        overlay.boxes.push_back(drawLegend(*loaded.scene.paint.legend, size));
    addMeasures(loaded.scene.description.measures, measureUnits(loaded), session.camera, size, overlay);
    return overlay;
}

/// Thumbnails are written in place: the file manager may have created the file and hold it open.
PngPlan pngPlan(const RenderSession& session, const Options& options, const std::string& path) {
    const RenderSettings& settings = session.settings;
    PngPlan plan{path, {settings.width, settings.height}, toneMappingOf(session), {}, {}, Writing::kWhole};
    if (options.thumbnail != 0) plan.writing = Writing::kInPlace;
    plan.place = options.place;
    plan.is_panorama = session.camera.panorama && session.camera.eyes_apart == 0;
    plan.overlay = overlayOf(session);
    return plan;
}

void writeImage(RenderSession& session, const Options& options, const std::string& path, const std::string& signature,
                Film film) {
    if (!path.ends_with(".exr")) {
        PngPicture picture(session.device, pngPlan(session, options, path));
        picture.addRows(film, 0, film.height);
        return picture.finish();
    }
    const std::uint32_t samples = mostSamples(film);
    writeSavedFilm(path, {std::move(film), samples, session.settings.seed, signature});
}

/// "; N of M rows have no samples and are black", or "".
std::string emptyRows(const RenderSession& session, const FrameState& state) {
    if (state.empty_rows == 0) return "";
    return "; " + std::to_string(state.empty_rows) + " of " + std::to_string(session.settings.height) +
           " rows have no samples and are black";
}

const char* resumeAdvice(const std::string& path) { return path.ends_with(".exr") ? "; continue with --resume" : ""; }

/// Warns of rows that a time limit left without samples.
void reportEmptyRows(const std::string& path, const RenderSession& session, const FrameState& state) {
    if (state.empty_rows == 0) return;
    std::fprintf(stderr, "pointrt-view: %s: the time limit was reached during the first sample%s\n", path.c_str(),
                 emptyRows(session, state).c_str());
}

void reportInterrupt(const std::string& path, const RenderSession& session, const FrameState& state) {
    if (state.traced == 0)
        std::fprintf(stderr, "pointrt-view: %s: interrupted before the first sample\n", path.c_str());
    else
        std::fprintf(stderr, "pointrt-view: %s: interrupted at %u of %u samples%s%s\n", path.c_str(), state.samples,
                     session.settings.spp, emptyRows(session, state).c_str(), resumeAdvice(path));
}

/// Reports an incomplete picture to the user.
void reportEnd(const Options& options, const RenderSession& session, const FrameState& state, const Report& report) {
    const std::string& path = options.output;
    if (interrupted())
        reportInterrupt(path, session, state);
    else if (state.traced == 0 && !options.quiet)
        std::fprintf(stderr, "pointrt-view: %s: nothing to do: it already has %u samples\n", path.c_str(),
                     state.samples);
    else
        reportEmptyRows(path, session, state);
    if (options.verbose && state.traced > 0)
        std::fprintf(stderr, "%u samples, noise %.4f; denoised in %.0f ms; wrote %s\n", report.samples, report.noise,
                     report.denoise_ms, path.c_str());
}

/// The plan of a picture that gets all its samples, with the denoiser if requested.
PngPlan pngPlanFiltered(const RenderSession& session, const Options& options) {
    const RenderSettings& settings = session.settings;
    PngPlan plan = pngPlan(session, options, options.output);
    const bool wraps = session.camera.panorama;
    if (wantsDenoising(session, options, settings.spp))
        plan.filter = {plan.size, settings.spp > 1, !plan.tone.has_alpha, filterTileFor(plan.size, wraps), wraps};
    return plan;
}

/// Writes the picture while it is rendered; the time for writing is not counted as rendering.
void renderInRows(RenderSession& session, const Options& options, Report& report) {
    const Clock::time_point start = Clock::now();
    PngPicture picture(session.device, pngPlanFiltered(session, options));
    NoiseMeter noise(reportsNoise(options) && session.settings.spp > 1
                         ? std::size_t{session.settings.width} * session.settings.height
                         : 0);
    const double made_ms = millisecondsSince(start);
    double taken_ms = 0;
    FrameJob job = jobOf(session, options);
    job.take_rows = [&](const Film& rows) {
        const HostSpan span(session.profile ? &*session.profile : nullptr, "filter and file");
        const Clock::time_point taken = Clock::now();
        if (reportsNoise(options)) noise.addRows(rows);
        picture.addRows(rows, 0, rows.height);
        taken_ms += millisecondsSince(taken);
    };
    const FrameState state = renderShown(session, options, job, {}, report);
    report.first_frame_seconds = secondsSinceStart() - 1e-3 * (made_ms + taken_ms);
    report.frame_ms.back() -= taken_ms;
    if (state.traced > 0) picture.finish();
    report.samples = state.samples;
    report.noise = noise.noise();
    report.denoise_ms = picture.filterMilliseconds();
    reportEnd(options, session, state, report);
}

std::string signatureFor(const RenderSession& session, const std::string& path) {
    return path.ends_with(".exr") ? filmSignature(session.loaded->scene, session.settings, session.camera,
                                                  session.loaded->tracer.programs.form)
                                  : "";
}

/// Renders one picture of a turntable. Returns false, without writing the picture, if interrupted.
bool renderTurntablePicture(RenderSession& session, const Options& options, std::uint32_t turn,
                            RenderProgress& progress, Report& report) {
    const std::string path = frameName(options.output, turn);
    const std::string place = "picture " + std::to_string(turn + 1) + " of " + std::to_string(options.turntable) + ", ";
    FrameJob job = jobOf(session, options);
    job.progress = [&](const FrameState& state, double share) {
        progress.update((turn + share) / options.turntable, place + detailOf(state));
    };
    const FrameState state = renderTimed(session, job, {}, report);
    if (turn == 0) report.first_frame_seconds = secondsSinceStart();
    if (interrupted()) return false;
    Film film = finishFilm(session, session.renderer->takeFilm(), options, state, report);
    if (interrupted()) return false;
    writeImage(session, options, path, signatureFor(session, path), std::move(film));
    reportEmptyRows(path, session, state);
    return true;
}

} // namespace

void renderPicture(RenderSession& session, const Options& options, Report& report) {
    requirePictureMemory(session, options);
    if (!options.output.empty()) catchInterrupts();
    if (writesAsItRenders(options)) return renderInRows(session, options, report);
    const std::string signature = signatureFor(session, options.output);
    std::optional<Film> start;
    if (options.resume) start = filmToResume(options.output, signature, session.settings);
    const bool denoised_again = start && session.settings.denoise == DenoiseChoice::kOn;
    const FrameState state = renderFrames(session, options, std::move(start), report);
    Film film = session.renderer->takeFilm();
    dropRenderer(session);
    film = finishFilm(session, std::move(film), options, state, report);
    if (options.output.empty()) return;
    if (state.traced > 0 || denoised_again) writeImage(session, options, options.output, signature, std::move(film));
    reportEnd(options, session, state, report);
}

void renderTurntable(RenderSession& session, const Options& options, Report& report) {
    const Camera first = session.camera;
    requirePictureMemory(session, options);
    catchInterrupts();
    RenderProgress progress(options.quiet, options.verbose, options.progress_lines);
    std::uint32_t turn = 0;
    for (; turn < options.turntable; ++turn) {
        session.camera = movingCamera(*session.loaded, first, options.follows_views, turn, options.turntable);
        if (!renderTurntablePicture(session, options, turn, progress, report)) break;
    }
    progress.finish();
    if (turn < options.turntable)
        std::fprintf(stderr, "pointrt-view: %s: interrupted after %u of %u pictures\n", options.output.c_str(), turn,
                     options.turntable);
    else if (options.verbose)
        std::fprintf(stderr, "wrote %u pictures, the last %s\n", turn, frameName(options.output, turn - 1).c_str());
}

} // namespace pointrt
