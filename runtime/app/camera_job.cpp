// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/camera_job.h"
#include "format/os/process_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/base/same_file.h"
#include "format/os/interrupt.h"
#include "runtime/app/camera_pictures.h"
#include "runtime/render/camera_series.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene/camera_range.h"
#include "runtime/scene_io/shot_names.h"
#include "runtime/scene_io/transforms_write.h"
#include "runtime/session/settings.h"
#include "runtime/util/clock.h"
#include "runtime/util/output_file.h"
#include "runtime/util/parse.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;
constexpr const char* kList = "transforms.json";
/// A thousandth of a unit, nerfstudio's default scale of depth pictures.
constexpr double kFinestDepth = 1e-3;
constexpr double kMostDepths = 65535;

std::string listPath(const Options& options) { return (fs::path(options.output) / kList).string(); }

void makeFolder(const std::string& path) {
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure) throw Error{ExitCode::kCannotWrite, path + ": " + failure.message()};
}

/// Refuses to overwrite the list that is read.
void requireListApart(const Options& options) {
    const fs::path given(options.cameras);
    for (const std::string& input : {given.string(), (given / kList).string()})
        if (isSameFile(listPath(options), input))
            throw Error{ExitCode::kBadUsage, listPath(options) + ": -o would overwrite the list of cameras"};
}

void requireSizes(const std::vector<CameraShot>& shots, const Options& options) {
    if (!options.choices.size) return;
    for (const CameraShot& shot : shots)
        if (shot.size != *options.choices.size)
            throw Error{ExitCode::kBadUsage, "--size: " + shot.place + "has " + std::to_string(shot.size.width) + "x" +
                                                 std::to_string(shot.size.height) +
                                                 "; --size is only for lists without sizes"};
}

void reportDistortion(const std::vector<CameraShot>& shots, const Options& options) {
    const auto distorted =
        std::count_if(shots.begin(), shots.end(), [](const CameraShot& shot) { return !shot.distortion.empty(); });
    if (distorted == 0 || options.quiet) return;
    std::fprintf(stderr, "pointrt-view: %s: the lenses of %zu of %zu cameras have distortion, which is ignored\n",
                 options.cameras.c_str(), static_cast<std::size_t>(distorted), shots.size());
}

Camera cameraOf(const CameraShot& shot, const Bounds& bounds) {
    if (!isWithinCameraRange(shot.pose.eye, bounds.lo, bounds.hi))
        throw Error{ExitCode::kBadInput,
                    shot.place + "the camera of " + printable(shot.name) + " is more than 10000 scene radii away"};
    return pinholeCamera(shot.pose, shot.lens, shot.size);
}

/// The largest distance from an eye to a corner of the scene.
double farthestDepth(const std::vector<CameraShot>& shots, const Bounds& bounds) {
    double farthest = 0;
    for (const CameraShot& shot : shots) {
        const Vec3 low = absolute(shot.pose.eye - bounds.lo), high = absolute(shot.pose.eye - bounds.hi);
        farthest =
            std::max(farthest, length(Vec3{std::max(low.x, high.x), std::max(low.y, high.y), std::max(low.z, high.z)}));
    }
    return farthest;
}

double depthUnit(const CameraPlan& plan, const Options& options, const Bounds& bounds) {
    if (!options.camera_output.depth) return 0;
    if (options.camera_output.depth_unit) return *options.camera_output.depth_unit;
    double unit = kFinestDepth;
    const double farthest = farthestDepth(plan.shots, bounds);
    for (int power = -2; unit * kMostDepths < farthest; ++power) unit = std::pow(10.0, power);
    return unit;
}

SeriesShot seriesShot(const Camera& camera, PixelSize size, const Options& options, bool filtered) {
    const CameraOutput& output = options.camera_output;
    const bool first_hits = output.depth || output.normal || output.instance || output.exr || filtered;
    const bool refines = options.limits.seconds || options.limits.noise; // refining needs the light components
    return {camera, size, first_hits, output.exr || refines};
}

/// Renders the pictures of a plan one by one.
class CameraRun {
public:
    CameraRun(RenderSession& session, const CameraPlan& plan, const Options& options, Report& report)
        : session_(session), plan_(plan), options_(options), report_(report),
          series_(session.device, *session.loaded, options.memory.value_or(kTileMemory)),
          progress_(options.quiet, options.verbose, options.progress_lines),
          files_{options.output, options.camera_output, depthUnit(plan, options, session.loaded->scene.bounds),
                 toneMapping(session.loaded->scene.description, session.settings.exposure)} {
        list_.offset = offsetFor(session.loaded->scene.bounds.lo, session.loaded->scene.bounds.hi);
        list_.depth_unit = files_.depth_unit;
    }

    void run() {
        for (const CameraShot& shot : plan_.shots) cameraOf(shot, session_.loaded->scene.bounds);
        for (std::size_t i = 0; i < plan_.shots.size() && renderShot(i); ++i) continue;
        progress_.finish();
        if (!list_.shots.empty()) writeTransforms(listPath(options_), list_);
        reportEnd();
    }

private:
    FrameJob jobOf(std::size_t i) {
        FrameJob job;
        job.samples = session_.settings.spp;
        job.limits = options_.limits;
        job.interrupted = interrupted;
        job.band_by_band = !options_.camera_output.exr; // EXRs are rendered like single EXRs
        const std::string place =
            "picture " + std::to_string(i + 1) + " of " + std::to_string(plan_.shots.size()) + ", ";
        job.progress = [this, i, place](const FrameState& state, double share) {
            progress_.update((static_cast<double>(i) + share) / static_cast<double>(plan_.shots.size()),
                             place + std::to_string(static_cast<std::uint32_t>(state.mean)) + " samples");
        };
        return job;
    }

    /// Returns false, without writing the picture, if interrupted.
    bool renderShot(std::size_t i) {
        const CameraShot& shot = plan_.shots[i];
        const bool filtered = session_.settings.denoise == DenoiseChoice::kOn;
        const Clock::time_point begin = Clock::now();
        const std::clock_t cpu = std::clock();
        const Camera camera = cameraOf(shot, session_.loaded->scene.bounds);
        Film film = series_.render(seriesShot(camera, shot.size, options_, filtered), jobOf(i));
        if (i == 0) report_.first_frame_seconds = secondsSinceStart();
        report_.frame_ms.push_back(millisecondsSince(begin));
        report_.frame_cpu_ms.push_back(1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
        if (interrupted()) return false;
        report_.rays = series_.takeRays();
        reportCutRays(plan_.names[i], report_.rays);
        report_.samples = series_.state().samples;
        report_.noise = relativeNoise(film);
        if (filtered) (files_.tone.has_alpha ? denoiseFilm : denoisePicture)(session_.device, film, false);
        farther_ += writeCameraFiles(files_, plan_.names[i], shot.lens, film);
        list_.shots.push_back({shot, fileNames(options_.camera_output, plan_.names[i])});
        return true;
    }

    void reportEnd() const {
        const std::size_t count = list_.shots.size();
        if (farther_ > 0 && !options_.quiet)
            std::fprintf(
                stderr, "pointrt-view: %s: %llu pixels are farther than 65535 depth units of %s and are written as 0\n",
                options_.output.c_str(), static_cast<unsigned long long>(farther_),
                plainText(files_.depth_unit).c_str());
        if (count < plan_.shots.size())
            std::fprintf(stderr, "pointrt-view: %s: interrupted after %zu of %zu pictures\n", options_.output.c_str(),
                         count, plan_.shots.size());
        else if (options_.verbose)
            std::fprintf(stderr, "wrote %zu pictures and %s\n", count, listPath(options_).c_str());
    }

    RenderSession& session_;
    const CameraPlan& plan_;
    const Options& options_;
    Report& report_;
    CameraSeries series_;
    RenderProgress progress_;
    CameraFiles files_;
    TransformsFile list_;
    std::uint64_t farther_ = 0; ///< pixels beyond the range of depth
};

} // namespace

CameraPlan planCameras(Options& options) {
    CameraPlan plan;
    plan.shots = readCameraList(options.cameras, {options.choices.size, options.drops_distortion});
    plan.names = shotNames(plan.shots);
    requireSizes(plan.shots, options);
    requireListApart(options);
    makeFolder(options.output);
    requireWritable(listPath(options));
    reportDistortion(plan.shots, options);
    options.choices.size = plan.shots.front().size;
    return plan;
}

void renderCameras(RenderSession& session, const CameraPlan& plan, const Options& options, Report& report) {
    catchInterrupts();
    session.renderer.reset();
    CameraRun(session, plan, options, report).run();
}

} // namespace pointrt
