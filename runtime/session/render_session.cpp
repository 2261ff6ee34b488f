// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/render_session.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "runtime/render/film_resume.h"
#include "runtime/session/load_request.h"
#include "runtime/session/scene_notes.h"
#include "runtime/session/settings.h"
#include "runtime/session/without_effect.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

std::optional<SetReport> describeSets(const DeviceScene& scene) {
    if (scene.sets.empty()) return std::nullopt;
    SetReport report;
    for (const SceneSet& each : scene.sets) {
        const OpenedSet& set = each.opened;
        report.tiles += set.cut.tiles.size();
        report.bytes += set.cut.bytes;
        report.wanted_tiles += set.full_cut.tiles.size();
        report.wanted_bytes += set.full_cut.bytes;
        report.lost_tiles += static_cast<std::uint64_t>(std::count(set.missing.begin(), set.missing.end(), true));
    }
    return report;
}

void describe(const RenderSession& session, Report& report) {
    const RenderSettings& settings = session.settings;
    report.device = session.device.name;
    report.integrator = nameOf(kIntegratorNames, settings.integrator);
    report.width = settings.width;
    report.height = settings.height;
    report.spp = settings.spp;
    report.splats = session.loaded->scene.splat_count;
    report.sets = describeSets(session.loaded->scene);
    report.device_bytes = session.loaded->scene.device_bytes + deviceBytes(session.loaded->tracer);
}

/// Selects the film's layers.
void chooseLayers(RenderSession& session, const Options& options) {
    RenderSettings& settings = session.settings;
    // the denoiser needs first hits; if sampling may end early, the picture may turn out to need denoising
    const std::uint32_t fewest = options.limits.seconds || options.limits.noise ? 1 : settings.spp;
    settings.first_hits |= wantsDenoising(session, options, fewest);
    // resumable and unfinished films keep the light components
    settings.light_parts =
        options.output.ends_with(".exr") || options.turntable != 0 || options.limits.seconds || options.limits.noise;
}

void print(const Options& options, const std::vector<std::string>& lines) {
    if (options.quiet || options.thumbnail != 0) return;
    for (const std::string& line : lines) std::fprintf(stderr, "pointrt-view: %s\n", line.c_str());
}

void reportWithoutEffect(const Options& options, const DeviceScene& scene, Integrator integrator) {
    const bool has_walked =
        std::any_of(scene.files.begin(), scene.files.end(), [](const DeviceScan& each) { return !each.queries_rays; });
    const SceneTraits traits = {!scene.sets.empty(), (scene.features & FEATURE_SECONDARY_RAYS) != 0, has_walked,
                                usesLights(integrator)};
    print(options, optionsWithoutEffect(options, traits));
}

} // namespace

RenderSession::RenderSession(const Options& options)
    : device(createDevice({.selector = options.device, .verbose = options.verbose, .traversal = options.traversal})) {}

RenderSession::~RenderSession() {
    renderer.reset();
    loaded.reset();
    if (profile) destroyPassClock(device, profile->clock);
    destroyDevice(device);
}

void loadSession(RenderSession& session, SceneDescription description, const Options& options, Report& report) {
    const Clock::time_point start = Clock::now();
    const bool up_is_given = description.up || options.camera.up;
    LoadRequest request = loadRequest(options, std::move(description));
    request.refines_tiles = true;
    if (options.resume) request.form = formToResume(options.output);
    session.loaded = loadScene(session.device, session.device, request, LoadStage{});
    session.settings = session.loaded->settings;
    session.camera = session.loaded->camera;
    session.notes = sceneNotes(*session.loaded, up_is_given);
    reportWithoutEffect(options, session.loaded->scene, session.settings.integrator);
    chooseLayers(session, options);
    if (options.profile) {
        session.profile.emplace();
        session.profile->clock = createPassClock(session.device);
        session.loaded->tracer.profile = &*session.profile;
    }
    session.renderer.emplace(session.device, session.loaded->tracer);
    report.load_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    describe(session, report);
}

void printNotes(const RenderSession& session, const Options& options) { print(options, session.notes); }

bool wantsDenoising(const RenderSession& session, const Options& options, std::uint32_t samples) {
    return wantsDenoising(options, session.settings, session.loaded->scene.description, samples,
                          session.loaded->subject);
}

void dropRenderer(RenderSession& session) {
    session.renderer.reset();
    destroyBandTracer(session.device, session.loaded->tracer);
}

} // namespace pointrt
