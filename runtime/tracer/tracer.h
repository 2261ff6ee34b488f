// SPDX-License-Identifier: Apache-2.0
// Pictures, sample by sample: bands of rows (band_tracer.h) one after the other.
#pragma once

#include <functional>
#include <memory>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/device.h"
#include "runtime/image/film.h"
#include "runtime/scene/render_settings.h"
#include "runtime/tracer/frame_loop.h"

namespace pointrt {

struct TracerState;

/// Pipelines, per-pixel buffers and descriptor sets for one image size and scene.
struct Tracer {
    std::shared_ptr<TracerState> state;
};

/// scene must be furnished, and outlive the tracer.
Tracer createTracer(Device& device, const DeviceScene& scene, const RenderSettings& settings, const Camera& camera);
void destroyTracer(Device& device, Tracer& tracer);

/// For the frames to come.
void setCamera(Tracer& tracer, const Camera& camera);

/// Renders every sample from scratch and returns the rays it counted. progress gets the share done in [0, 1].
RayCounts renderFrame(Device& device, Tracer& tracer, const std::function<void(double share)>& progress);

/// Goes on with the film start, or begins one without, until job (of settings.spp samples) is done or interrupted; adds
/// the rays to counts. start must come from the same scene, settings and camera.
FrameState renderUntil(Device& device, Tracer& tracer, const FrameJob& job, const Film* start, RayCounts& counts);

/// readFilm's, which the tracer gives away until the next frame.
Film takeFilm(Tracer& tracer);

/// The picture of the last frame; with settings.first_hits also the first-hit channels, in input units.
const Film& readFilm(const Tracer& tracer);

/// Bytes of the tracer's own buffers; the scene's come on top.
std::uint64_t deviceBytes(const Tracer& tracer);

} // namespace pointrt
