// SPDX-License-Identifier: Apache-2.0
// Wavefront ray tracing of a band of rows: a few dispatches for each bounce of a sample.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/image/film.h"
#include "runtime/render/caustics.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/pass_profile.h"
#include "runtime/render/programs.h"
#include "runtime/render/targets.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Programs, buffers and descriptor sets for pictures of a scene. It does not move: targets point into programs.
struct BandTracer {
    const DeviceScene* scene = nullptr;
    bool shadows = true;
    Programs programs;
    FrameBuffers buffers;
    CausticMaps caustics;
    Targets targets;
    PassProfile* profile = nullptr;     ///< of its passes, where one is wanted
    const Buffer* hit_counts = nullptr; ///< where one is wanted: gets how many rays of the last pass hit each target

    BandTracer() = default;
    BandTracer(const BandTracer&) = delete;
    BandTracer& operator=(const BandTracer&) = delete;
};

/// Fills tracer, which is empty, for bands of up to so many lanes (lanesOf) out of films of up to film_pixels, without
/// photons. scene must have its tables and outlive the tracer.
void createBandTracer(Device& device, BandTracer& tracer, const DeviceScene& scene, const RenderSettings& settings,
                      std::uint32_t lanes, std::uint64_t film_pixels, FormRequest form = {});
/// Leaves it empty, which it may have been.
void destroyBandTracer(Device& device, BandTracer& tracer);

/// Whether the scene throws caustics, and the settings' integrator shows them.
bool wantsPhotons(const DeviceScene& scene, const RenderSettings& settings);
/// Puts the first photons of its scene as it is now, where it wants any, in place of those there were, and binds them.
void castPhotons(Device& device, BandTracer& tracer, const RenderSettings& settings);
/// Works for some milliseconds on the map that a sample of a picture of so many pixels shows; true where it is bound.
/// Of a scene without photons none is wanted.
bool showPhotons(Device& device, BandTracer& tracer, std::uint32_t sample, std::uint64_t pixels);
/// Leaves the photons there were out.
void forgetPhotons(BandTracer& tracer);

/// Makes room for films of up to so many pixels; what the film holds is lost.
void resizeFilm(Device& device, BandTracer& tracer, std::uint64_t film_pixels);
/// To be called after the scene was furnished anew with the same features.
void rebind(Device& device, BandTracer& tracer);

/// Bytes of its buffers on the device, without the scene's.
std::uint64_t deviceBytes(const BandTracer& tracer);

/// Puts camera and settings for a band on the device. film: where its pixels lie in the film.
void openBand(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera, Band band,
              FilmPlace film);

/// A sample of the open band, under way.
struct BandSample {
    std::uint32_t width = 0, rows = 0; ///< of the band, pixels
    std::uint32_t number = 0;          ///< 0: clears the film
    bool at_centers = false;           ///< rays go through the pixels' centres
    bool preview = false;              ///< hard shadows of the first lamp alone: without noise, and soon
    bool first_hits = false;           ///< also depth, normal and ids of the centre rays
    bool only_first_hits = false;      ///< nothing else
    bool at_places = false; ///< rays go through listed pixels; first hits are what those see, the backdrop too
    std::uint32_t pass = 0; ///< the next one; 0: nothing is traced yet
    bool done = false;
};

/// Pixels in a row of those that are traced by a list of their places (FrameBuffers::places).
constexpr std::uint32_t kPlacesRow = TILE_SIDE;

/// The same for so many listed pixels of the picture, in rows of kPlacesRow. Returns their sample.
BandSample openPlaces(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                      std::uint32_t count, FilmPlace film);

/// Traces on, in one submission: the camera rays, where pass is 0, and passes bounces. When that was the end, says so
/// in sample and adds its rays to counts.
void traceOn(Device& device, const BandTracer& tracer, BandSample& sample, std::uint32_t passes, RayCounts& counts);

} // namespace pointrt
