// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/band_tracer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/render/frame_params.h"
#include "runtime/render/instance_culling.h"
#include "runtime/render/map_schedule.h"
#include "runtime/render/sample_recorder.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

GaussianRoom gaussianRoom(const DeviceScene& scene) {
    if (!hasGaussians(scene)) return GaussianRoom::kNone;
    return mergesGaussians(scene) ? GaussianRoom::kSeveral : GaussianRoom::kOne;
}

void bind(Device& device, BandTracer& tracer) {
    tracer.instances =
        bindTracedInstances(device, tracer.programs, *tracer.scene, tracer.buffers, shownMap(tracer.caustics));
}

/// Continues tracing the later photon map of that number, which replaces the current later map, so that at most two
/// maps are in memory. True once it is bound.
bool traceLaterMap(Device& device, BandTracer& tracer, std::uint32_t number) {
    CausticMaps& maps = tracer.caustics;
    if (!maps.job || maps.job->map() != number) {
        maps.job.reset();
        maps.later_number = 0;
        if (std::exchange(maps.shows_later, false)) rebind(device, tracer);
        destroyCaustics(device, maps.later);
        maps.job = std::make_unique<CausticJob>(device, *tracer.scene, tracer.programs,
                                                CausticOrder{kPhotons, number, maps.seed, maps.finest});
    }
    const OnError undo([&] { maps.job.reset(); });
    if (maps.job->step()) return false;
    maps.later = maps.job->take(maps.finest);
    maps.job.reset();
    maps.later_number = number;
    maps.shows_later = true;
    rebind(device, tracer);
    return true;
}

/// Divides the sample into parts that fit in the tracer's lanes.
std::vector<BandSample> partsOf(const BandTracer& tracer, const BandSample& sample) {
    if (lanesOf(sample.width, sample.rows) <= tracer.buffers.lanes) return {sample};
    std::vector<BandSample> parts;
    const std::uint32_t most = fittingRows(tracer, sample.width);
    for (std::uint32_t row = 0; row < sample.rows; row += most) {
        BandSample& part = parts.emplace_back(sample);
        part.rows = part.params.rows = std::min(most, sample.rows - row);
        part.params.first_row += row;
        part.params.film_first += row * sample.width;
    }
    return parts;
}

void recordPasses(PassCommands& commands, const BandTracer& tracer, BandSample& sample, std::uint32_t passes) {
    commands.beginSample(tilesOf(sample.width, sample.rows));
    SampleRecorder recorder(commands, tracer, sample);
    if (sample.pass == 0) {
        commands.setParams(tracer.buffers.params, sample.params);
        if ((sample.first_hits && !sample.at_listed_pixels) || sample.only_first_hits) recorder.firstHits();
        if (!sample.only_first_hits) recorder.begin();
        sample.pass = 1;
    }
    if (!sample.only_first_hits && tracer.programs.has_secondary_rays)
        for (std::uint32_t i = 0; i < passes; ++i) recorder.pass(sample.pass++);
    commands.endSample();
}

/// Records the passes of all parts of a sample, and the commands that follow them.
void recordParts(PassCommands& commands, const BandTracer& tracer, BandSample& sample, std::uint32_t passes,
                 const std::function<void(VkCommandBuffer)>& then) {
    for (BandSample part : partsOf(tracer, sample)) {
        recordPasses(commands, tracer, part, passes);
        sample.pass = part.pass;
    }
    if (then) commands.record(then);
}

/// Whether no path is left.
bool hasEnded(const gpu::Control& control) { return control.queued[0] + control.queued[1] == 0; }

void addRays(const gpu::Control& control, RayCounts& counts) {
    // 32-bit counters on the device, reset for each sample
    counts.primary += control.primary_rays;
    counts.shadow += control.shadow_rays;
    counts.secondary += control.secondary_rays;
    counts.cut += control.cut_rays;
}

} // namespace

void createBandTracer(Device& device, BandTracer& tracer, const DeviceScene& scene, const RenderSettings& settings,
                      std::uint32_t lanes, std::uint64_t film_pixels, FormRequest form) {
    tracer.scene = &scene;
    tracer.shadows = settings.shadows;
    const OnError undo([&] { destroyBandTracer(device, tracer); });
    tracer.buffers =
        createFrameBuffers(device, lanes, {film_pixels, settings.spp}, mayCull(scene), gaussianRoom(scene));
    tracer.programs = createPrograms(device, scene, settings, form);
    tracer.caustics.first = emptyCaustics(device);
    if (device.type != VK_PHYSICAL_DEVICE_TYPE_CPU) tracer.timer = createGpuTimer(device, kFramesInFlight);
    bind(device, tracer);
}

void destroyBandTracer(Device& device, BandTracer& tracer) {
    finishSubmitted(device);
    destroyGpuTimer(device, tracer.timer);
    destroyPrograms(device, tracer.programs);
    destroyTracedInstances(device, tracer.instances);
    destroyFrameBuffers(device, tracer.buffers);
    destroyCaustics(device, tracer.caustics);
    tracer.scene = nullptr;
}

bool needsPhotons(const DeviceScene& scene, const RenderSettings& settings) {
    return castsCaustics(scene) && usesLights(settings.integrator);
}

void tracePhotons(Device& device, BandTracer& tracer, const RenderSettings& settings) {
    CausticMaps maps;
    maps.seed = settings.seed;
    if (needsPhotons(*tracer.scene, settings)) {
        CausticJob job(device, *tracer.scene, tracer.programs, {kPhotons, 0, maps.seed});
        while (job.step()) {
        }
        maps.first = job.take(maps.finest);
    } else {
        maps.first = emptyCaustics(device);
    }
    destroyCaustics(device, tracer.caustics);
    tracer.caustics = std::move(maps);
    rebind(device, tracer);
}

bool usePhotonMap(Device& device, BandTracer& tracer, std::uint32_t sample, std::uint64_t pixels) {
    CausticMaps& maps = tracer.caustics;
    const std::uint32_t wanted = mapOfSample(sample, pixels);
    const bool later = wanted > 0 && maps.first.frame.count.x > 0;
    if (later && maps.later_number != wanted) {
        const HostSpan span(tracer.profile, "caustics");
        return traceLaterMap(device, tracer, wanted);
    }
    if (std::exchange(maps.shows_later, later) != later) rebind(device, tracer);
    return true;
}

void dropPhotons(BandTracer& tracer) {
    CausticMaps& maps = tracer.caustics;
    maps.first.frame.count.x = 0;
    maps.shows_later = false;
    maps.later_number = 0;
    maps.job.reset();
}

void resizeFilm(Device& device, BandTracer& tracer, FilmRoom film) {
    createFilm(device, tracer.buffers, film);
    rebind(device, tracer);
}

bool extendFilm(Device& device, BandTracer& tracer, std::uint32_t samples) {
    if (!extendFilm(device, tracer.buffers, samples)) return false;
    rebind(device, tracer);
    return true;
}

void rebind(Device& device, BandTracer& tracer) {
    destroyTracedInstances(device, tracer.instances);
    bind(device, tracer);
}

std::uint64_t deviceBytes(const BandTracer& tracer) {
    return tracer.buffers.device_bytes + tracer.instances.cull_groups.size() * sizeof(gpu::CullBoxes) +
           deviceBytes(tracer.caustics);
}

BandSample openBand(const BandTracer& tracer, const RenderSettings& settings, const Camera& camera, Band band,
                    FilmPlace film) {
    BandSample sample;
    sample.params = makeFrameParams(*tracer.scene, settings, camera, band.first_row, band.rows);
    sample.params.film_pixels = film.pixels;
    sample.params.film_first = film.first_pixel;
    sample.params.caustics = shownMap(tracer.caustics).frame;
    sample.width = settings.width;
    sample.rows = band.rows;
    return sample;
}

BandSample openPixelList(const BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                         std::uint32_t count, FilmPlace film) {
    const std::uint32_t rows = (count + kPixelListWidth - 1) / kPixelListWidth;
    BandSample sample = openBand(tracer, settings, camera, {0, rows}, film);
    sample.params.width = sample.width = kPixelListWidth;
    sample.at_centers = sample.first_hits = sample.at_listed_pixels = true;
    return sample;
}

void tracePasses(Device& device, const BandTracer& tracer, BandSample& sample, std::uint32_t passes, RayCounts& counts,
                 const std::function<void(VkCommandBuffer)>& then) {
    waitForSubmitted(device); // since counters of earlier submissions are read from the same buffer
    PassCommands commands(device, tracer.buffers.control, {tracer.buffers.control_read}, tracer.profile);
    const std::uint32_t first_pass = sample.pass;
    recordParts(commands, tracer, sample, passes, then);
    const std::vector<gpu::Control> parts = commands.finish();
    sample.done = std::all_of(parts.begin(), parts.end(), hasEnded);
    if (parts.size() > 1 && (!sample.done || first_pass > 0))
        throw std::logic_error("a sample of more lanes than the tracer has was not traced at once");
    if (!sample.done) return;
    for (const gpu::Control& part : parts) addRays(part, counts);
}

bool canOverlap(const BandTracer& tracer) { return tracer.timer.pool && !tracer.profile; }

PassesInFlight submitPasses(Device& device, BandTracer& tracer, BandSample& sample, std::uint32_t passes,
                            const std::function<void(VkCommandBuffer)>& then, Submission submission) {
    tracer.place = (tracer.place + 1) % kFramesInFlight;
    PassCommands commands(device, tracer.buffers.control, {tracer.buffers.control_read, tracer.place, &tracer.timer},
                          nullptr);
    recordParts(commands, tracer, sample, passes, then);
    sample.done = true;
    const std::uint64_t number = submission == Submission::kNow ? commands.submit() : commands.submitLater();
    return {number, tracer.place, commands.samples()};
}

double finishPasses(Device& device, const BandTracer& tracer, const PassesInFlight& passes, RayCounts& counts) {
    waitFor(device, passes.submission);
    for (const gpu::Control& part : readCounters(device, {tracer.buffers.control_read, passes.place}, passes.samples)) {
        if (!hasEnded(part)) throw std::logic_error("paths continue after the last pass");
        addRays(part, counts);
    }
    return elapsedMilliseconds(device, tracer.timer, passes.place).value() / 1e3;
}

bool endsIn(const BandTracer& tracer, const RenderSettings& settings, std::uint32_t passes) {
    const Programs& programs = tracer.programs;
    return !programs.has_secondary_rays || (!programs.defers_rays && passes >= settings.bounces);
}

std::uint32_t fittingRows(const BandTracer& tracer, std::uint32_t width) {
    return std::max(tracer.buffers.lanes / lanesOf(width, TILE_SIDE), 1u) * TILE_SIDE;
}

} // namespace pointrt
