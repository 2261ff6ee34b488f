// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/render_session.h"

#include <chrono>
#include <utility>

#include "runtime/scene/default_lighting.h"
#include "runtime/session/scene_cameras.h"
#include "runtime/session/settings.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

void describe(const RenderSession& session, Report& report) {
    const RenderSettings& settings = session.settings;
    report.device = session.device.name;
    report.integrator = nameOf(kIntegratorNames, settings.integrator);
    report.width = settings.width;
    report.height = settings.height;
    report.spp = settings.spp;
    report.splats = session.scene->splat_count;
    report.device_bytes = session.scene->device_bytes + deviceBytes(*session.tracer);
}

} // namespace

RenderSession::RenderSession(const Options& options) : device(createDevice({options.device, options.verbose})) {}

RenderSession::~RenderSession() {
    if (tracer) destroyTracer(device, *tracer);
    if (scene) destroyDeviceScene(device, *scene);
    destroyDevice(device);
}

void loadSession(RenderSession& session, SceneDescription description, const Options& options, Report& report) {
    const Clock::time_point start = Clock::now();
    session.settings = resolveSettings(options, description);
    RenderSettings& settings = session.settings;
    session.scene = openScene(session.device, std::move(description), options.verbose);
    DeviceScene& scene = *session.scene;
    session.camera = framedCamera(scene, settings);
    addSurroundings(scene.description, settings, stagingCamera(scene, options), scene.bounds.lo, scene.bounds.hi);
    uploadSceneTables(session.device, scene, settings);
    // the denoiser is guided by first hits; where the samples may end early, it may be wanted in the end
    const std::uint32_t fewest = options.limits.seconds || options.limits.noise ? 1 : settings.spp;
    settings.first_hits |= wantsDenoising(options, settings, scene.description, fewest);
    // what is to be gone on with, or kept, keeps the parts
    settings.light_parts =
        options.output.ends_with(".exr") || options.turntable != 0 || options.limits.seconds || options.limits.noise;
    session.tracer = createTracer(session.device, scene, settings, session.camera);
    report.load_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    describe(session, report);
}

} // namespace pointrt
