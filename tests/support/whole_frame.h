// SPDX-License-Identifier: Apache-2.0
// Renders the complete film of a scene that a test has uploaded itself.
#pragma once

#include "runtime/render/progressive_renderer.h"

namespace pointrt::test {

/// Renders all samples of the settings in one call. scene must have its tables.
inline Film wholeFrame(Device& device, const DeviceScene& scene, const RenderSettings& settings, const Camera& camera) {
    const FrameTiling tiling = tilingFor(device, settings.width, settings.height);
    const TracerSize size = tracerSizeFor(tiling, settings.width);
    BandTracer tracer;
    createBandTracer(device, tracer, scene, settings, size.lanes, size.film_pixels);
    tracePhotons(device, tracer, settings);
    ProgressiveRenderer renderer(device, tracer);
    FrameJob job;
    job.samples = settings.spp;
    renderer.begin({settings, camera, tiling}, job);
    renderer.run();
    Film film = renderer.takeFilm();
    destroyBandTracer(device, tracer);
    return film;
}

} // namespace pointrt::test
