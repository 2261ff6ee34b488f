// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/camera_series.h"

#include <algorithm>
#include <string>
#include <utility>

#include "format/base/error.h"
#include "format/os/memory.h"
#include "runtime/render/film_readout.h"
#include "runtime/render/picture_tiles.h"
#include "runtime/util/memory_text.h"

namespace pointrt {
namespace {

TracerSize roomFor(const Device& device, const RenderSettings& settings) {
    return tracerSizeFor(tilingFor(device, settings.width, settings.height), settings.width);
}

void requireMemory(const RenderSettings& settings) {
    const std::uint64_t bytes = std::uint64_t{settings.width} * settings.height * filmBytesPerPixel(settings);
    const std::uint64_t available = availableMemory();
    if (bytes <= available) return;
    const SizeAndLimit shown = sizeAndLimit(bytes, available, gibibytes);
    throw Error{ExitCode::kCannotRun, "a picture of " + std::to_string(settings.width) + "x" +
                                          std::to_string(settings.height) + " pixels needs " + shown.size +
                                          " of memory, but only " + shown.limit + " are free"};
}

} // namespace

CameraSeries::CameraSeries(Device& device, LoadedScene& loaded, std::uint64_t memory)
    : device_(device), loaded_(loaded), room_(roomFor(device, loaded.settings)), renderer_(device, loaded.tracer) {
    request_.memory = memory;
    request_.form = loaded.tracer.programs.form;
}

/// Grows the tracer to the size of the settings, keeping room for all earlier sizes.
void CameraSeries::makeRoom() {
    const TracerSize wanted = roomFor(device_, loaded_.settings);
    if (wanted.lanes <= room_.lanes && wanted.film_pixels <= room_.film_pixels) return;
    const TracerSize both{std::max(wanted.lanes, room_.lanes), std::max(wanted.film_pixels, room_.film_pixels)};
    room_ = {}; // in case of an exception
    destroyBandTracer(device_, loaded_.tracer);
    createBandTracer(device_, loaded_.tracer, loaded_.scene, loaded_.settings, both.lanes, both.film_pixels,
                     request_.form);
    tracePhotons(device_, loaded_.tracer, loaded_.settings);
    room_ = both;
}

void CameraSeries::aim(const SeriesShot& shot) {
    RenderSettings& settings = loaded_.settings;
    loaded_.camera = shot.camera;
    settings.width = shot.size.width;
    settings.height = shot.size.height;
    settings.first_hits = shot.first_hits;
    settings.light_parts = shot.light_parts;
    requireMemory(settings);
    makeRoom();
    if (loaded_.scene.sets.empty()) return;
    reselectTiles(device_, loaded_, request_);
    if (needsPhotons(loaded_.scene, settings)) tracePhotons(device_, loaded_.tracer, settings);
}

Film CameraSeries::render(const SeriesShot& shot, const FrameJob& job) {
    aim(shot);
    const RenderSettings& settings = loaded_.settings;
    renderer_.begin({settings, shot.camera, tilingFor(device_, settings.width, settings.height)}, job);
    state_ = renderer_.run();
    return renderer_.takeFilm();
}

} // namespace pointrt
