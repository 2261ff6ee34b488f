// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/tracer.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "runtime/tracer/band_tracer.h"
#include "runtime/tracer/film_readout.h"

namespace pointrt {

namespace {

/// Pixels in flight: their states take about 500 bytes each, no more than 128 in any buffer, so that none nears the 128
/// MiB that some drivers allow in a storage binding. Larger images are rendered in bands of rows.
constexpr std::uint32_t kBandPixels = 1u << 19;
/// A processor needs no more lanes than keep it busy: a band is traced strip by strip there. With half of that its
/// threads wait for each other more often, for a tenth of a frame (tests/bench/NOTES.md).
constexpr std::uint32_t kStripPixels = 1u << 18;

} // namespace

struct TracerState {
    RenderSettings settings;
    Camera camera;
    const DeviceScene* scene = nullptr;
    std::uint32_t band_rows = 0, strip_rows = 0;
    BandTracer bands;
    Film result;
};

namespace {

void renderSample(Device& device, TracerState& state, const FrameBand& band, RayCounts& counts) {
    const RenderSettings& settings = state.settings;
    const std::uint32_t band_pixels = settings.width * band.band.rows;
    for (std::uint32_t row = 0; row < band.band.rows; row += state.strip_rows) {
        const std::uint32_t rows = std::min(state.strip_rows, band.band.rows - row);
        openBand(device, state.bands, settings, state.camera, {band.band.first_row + row, rows},
                 {band_pixels, row * settings.width});
        BandSample sample{settings.width, rows, band.samples, settings.spp == 1};
        sample.first_hits = band.samples == 0 && settings.first_hits;
        while (!sample.done) traceOn(device, state.bands, sample, settings.bounces, counts);
    }
}

/// Puts what the film has of a band on the device.
void restoreBand(Device& device, TracerState& state, const FrameBand& band) {
    if (band.samples > 0) restoreLight(device, state.bands.buffers, band.band, band.samples, state.result);
}

} // namespace

Tracer createTracer(Device& device, const DeviceScene& scene, const RenderSettings& settings, const Camera& camera) {
    Tracer tracer{std::make_shared<TracerState>()};
    TracerState& state = *tracer.state;
    state.settings = settings;
    state.camera = camera;
    state.scene = &scene;
    state.band_rows = std::clamp(kBandPixels / settings.width, 1u, settings.height);
    state.strip_rows = state.band_rows;
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU)
        state.strip_rows =
            std::min(state.band_rows, std::max(kStripPixels / settings.width / TILE_SIDE * TILE_SIDE, TILE_SIDE));
    createBandTracer(device, state.bands, scene, settings, lanesOf(settings.width, state.strip_rows),
                     std::uint64_t{settings.width} * state.band_rows, kPhotons);
    return tracer;
}

void setCamera(Tracer& tracer, const Camera& camera) { tracer.state->camera = camera; }

std::uint64_t deviceBytes(const Tracer& tracer) { return deviceBytes(tracer.state->bands); }

void destroyTracer(Device& device, Tracer& tracer) {
    if (tracer.state) destroyBandTracer(device, tracer.state->bands);
    tracer.state.reset();
}

RayCounts renderFrame(Device& device, Tracer& tracer, const std::function<void(double)>& progress) {
    FrameJob job;
    job.samples = tracer.state->settings.spp;
    if (progress) job.progress = [&](const FrameState&, double share) { progress(share); };
    RayCounts counts;
    renderUntil(device, tracer, job, nullptr, counts);
    return counts;
}

FrameState renderUntil(Device& device, Tracer& tracer, const FrameJob& job, const Film* start, RayCounts& counts) {
    TracerState& state = *tracer.state;
    const RenderSettings& settings = state.settings;
    if (start)
        state.result = *start;
    else
        allocateFilm(settings, state.result);
    FrameSteps steps;
    steps.open = [&](const FrameBand& band) { restoreBand(device, state, band); };
    steps.trace = [&](const FrameBand& band) { renderSample(device, state, band, counts); };
    steps.store = [&](const FrameBand& band, bool was_new) {
        storeLight(device, state.bands.buffers, band.band, band.samples, state.result);
        if (was_new && settings.first_hits)
            storeFirstHits(device, state.bands.buffers, band.band, *state.scene, settings, state.camera, state.result);
    };
    steps.noise = [&] { return relativeNoise(state.result); };
    steps.seconds = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    return runFrame(job, frameBands(state.result, state.band_rows), steps);
}

const Film& readFilm(const Tracer& tracer) { return tracer.state->result; }

Film takeFilm(Tracer& tracer) { return std::exchange(tracer.state->result, {}); }

} // namespace pointrt
