// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/band_tracer.h"

#include <algorithm>
#include <utility>

#include "runtime/tracer/frame_params.h"
#include "runtime/tracer/sample_recorder.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

void createBindings(Device& device, BandTracer& tracer) {
    const DeviceScene& scene = *tracer.scene;
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(scene.instances.size(), 1));
    tracer.pool = createDescriptorPool(device, 2 * count);
    const auto bind = [&](const Instance& instance) {
        return bindInstance(device, tracer.pool, tracer.programs, scene, instance, tracer.buffers, tracer.caustics);
    };
    for (const Instance& instance : scene.instances)
        tracer.targets.push_back({&programsFor(tracer.programs, scene, instance), bind(instance)});
    tracer.sets = tracer.targets.empty() ? bind(scene.blank) : tracer.targets.front().sets;
}

/// Whether there is anything after the camera rays' pass. Fused, that ends where instances are to be asked.
bool hasPasses(const BandTracer& tracer) {
    return tracer.programs.rays_go_on && (tracer.programs.form == PassForm::kQueued || !tracer.targets.empty());
}

} // namespace

void createBandTracer(Device& device, BandTracer& tracer, const DeviceScene& scene, const RenderSettings& settings,
                      std::uint32_t lanes, std::uint64_t film_pixels, FormRequest form) {
    tracer.scene = &scene;
    tracer.shadows = settings.shadows;
    const OnError undo([&] { destroyBandTracer(device, tracer); });
    tracer.buffers = createFrameBuffers(device, lanes, film_pixels);
    tracer.programs = createPrograms(device, scene, settings, form);
    tracer.caustics = emptyCaustics(device);
    createBindings(device, tracer);
}

void destroyBandTracer(Device& device, BandTracer& tracer) {
    destroyPrograms(device, tracer.programs);
    destroyDescriptorPool(device, tracer.pool);
    destroyFrameBuffers(device, tracer.buffers);
    destroyCaustics(device, tracer.caustics);
    tracer.targets.clear();
    tracer.sets = {};
    tracer.scene = nullptr;
}

bool wantsPhotons(const DeviceScene& scene, const RenderSettings& settings) {
    return castsCaustics(scene) && showsLight(settings.integrator);
}

void castPhotons(Device& device, BandTracer& tracer, const RenderSettings& settings) {
    CausticMap map = wantsPhotons(*tracer.scene, settings)
                         ? buildCaustics(device, *tracer.scene, tracer.programs, kPhotons)
                         : emptyCaustics(device);
    destroyCaustics(device, tracer.caustics);
    tracer.caustics = std::exchange(map, {});
    rebind(device, tracer);
}

void forgetPhotons(BandTracer& tracer) { tracer.caustics.frame.count.x = 0; }

void resizeFilm(Device& device, BandTracer& tracer, std::uint64_t film_pixels) {
    createFilm(device, tracer.buffers, film_pixels);
    rebind(device, tracer);
}

void rebind(Device& device, BandTracer& tracer) {
    destroyDescriptorPool(device, tracer.pool);
    tracer.targets.clear();
    createBindings(device, tracer);
}

std::uint64_t deviceBytes(const BandTracer& tracer) {
    return tracer.buffers.device_bytes + tracer.caustics.photons.bytes + tracer.caustics.buckets.bytes;
}

void openBand(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera, Band band,
              FilmPlace film) {
    gpu::FrameParams params = makeFrameParams(*tracer.scene, settings, camera, band.first_row, band.rows);
    params.film_pixels = film.pixels;
    params.film_first = film.first_pixel;
    params.caustics = tracer.caustics.frame;
    const HostSpan span(tracer.profile, "parameters");
    uploadBuffer(device, tracer.buffers.params, &params, sizeof params);
}

void traceOn(Device& device, const BandTracer& tracer, BandSample& sample, std::uint32_t passes, RayCounts& counts) {
    PassCommands commands(device, tracer.buffers.control, tilesOf(sample.width, sample.rows), tracer.profile);
    SampleRecorder recorder(commands, tracer, sample);
    if (sample.pass == 0) {
        if (sample.first_hits || sample.only_first_hits) recorder.firstHits();
        if (!sample.only_first_hits) recorder.begin();
        sample.pass = 1;
    }
    if (!sample.only_first_hits && hasPasses(tracer))
        for (std::uint32_t i = 0; i < passes; ++i) recorder.pass(sample.pass++);
    const gpu::Control control = commands.finish();
    // rays that had to wait, where surfaces reflect and refract, take more passes than a path has bounces
    sample.done = control.queued[0] + control.queued[1] == 0;
    if (!sample.done) return;
    // they are 32 bits wide on the device and start at 0 with each sample
    counts.primary += control.primary_rays;
    counts.shadow += control.shadow_rays;
    counts.secondary += control.secondary_rays;
}

} // namespace pointrt
