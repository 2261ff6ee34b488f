// SPDX-License-Identifier: Apache-2.0
// Ray tracing of a band of rows: a few dispatches for each bounce of a sample.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/gpu_timer.h"
#include "runtime/image/film.h"
#include "runtime/render/caustics.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/pass_profile.h"
#include "runtime/render/programs.h"
#include "runtime/render/traced_instances.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Programs, buffers and descriptor sets to render a scene. Not movable: instances point into programs.
struct BandTracer {
    const DeviceScene* scene = nullptr;
    bool shadows = true;
    Programs programs;
    FrameBuffers buffers;
    CausticMaps caustics;
    TracedInstances instances;
    PassProfile* profile = nullptr; ///< optional: records its passes
    /// Times kFramesInFlight submissions; without a query pool if submissions never overlap (submitPasses).
    GpuTimer timer;
    std::uint32_t place = 0; ///< of the last submission by submitPasses: its place in control_read and timer
    const Buffer* hit_counts =
        nullptr; ///< optional: receives the number of rays of the last pass that hit each instance

    BandTracer() = default;
    BandTracer(const BandTracer&) = delete;
    BandTracer& operator=(const BandTracer&) = delete;
};

/// Initialises the empty tracer for bands of up to `lanes` lanes (lanesOf) and films of up to film_pixels pixels, with
/// the settings' samples, without photons. scene must have its tables and outlive the tracer.
void createBandTracer(Device& device, BandTracer& tracer, const DeviceScene& scene, const RenderSettings& settings,
                      std::uint32_t lanes, std::uint64_t film_pixels, FormRequest form = {});
/// Leaves the tracer empty. The tracer may be empty already.
void destroyBandTracer(Device& device, BandTracer& tracer);

/// Whether the scene casts caustics and the settings' integrator shows them.
bool needsPhotons(const DeviceScene& scene, const RenderSettings& settings);
/// Traces the first photon map of the scene in its current state, if it needs photons, and binds it in place of the
/// current map.
void tracePhotons(Device& device, BandTracer& tracer, const RenderSettings& settings);
/// Works for some milliseconds on the photon map for this sample of a picture with this many pixels. True once it is
/// bound; always true if the scene has no photons.
bool usePhotonMap(Device& device, BandTracer& tracer, std::uint32_t sample, std::uint64_t pixels);
/// Renders without photons from now on.
void dropPhotons(BandTracer& tracer);

/// Reallocates the film; its contents are lost.
void resizeFilm(Device& device, BandTracer& tracer, FilmRoom film);
/// Makes room in the film for this many samples per pixel; keeps its contents. Returns whether the film is now in
/// another buffer.
bool extendFilm(Device& device, BandTracer& tracer, std::uint32_t samples);
/// Call after the scene's buffers have been rebuilt with the same features.
void rebind(Device& device, BandTracer& tracer);

/// Device memory of the tracer's buffers in bytes, without those of the scene.
std::uint64_t deviceBytes(const BandTracer& tracer);

/// A sample of a band in progress.
struct BandSample {
    gpu::FrameParams params{};         ///< camera and settings
    std::uint32_t width = 0, rows = 0; ///< size of the band in pixels
    std::uint32_t number = 0;          ///< number of the sample; 0 clears the film
    bool at_centers = false;           ///< rays go through pixel centres
    bool preview = false;              ///< hard shadows of the first light only: no noise
    bool first_hits = false;           ///< also depth, normal and ids of the rays through pixel centres
    bool only_first_hits = false;      ///< only those, no light
    bool at_listed_pixels = false; ///< rays go through the pixels of the pixel list; first hits include surroundings
    std::uint32_t pass = 0;        ///< number of the next pass; 0: nothing has been traced
    bool done = false;
};

/// A sample of a band for these settings. film: position of its pixels in the film. The band may have more lanes than
/// the tracer if endsIn(its passes) and it is not at listed pixels.
BandSample openBand(const BandTracer& tracer, const RenderSettings& settings, const Camera& camera, Band band,
                    FilmPlace film);

/// Width in pixels of the band that traces a pixel list (FrameBuffers::pixel_list).
constexpr std::uint32_t kPixelListWidth = TILE_SIDE;

/// openBand for the first count pixels of the pixel list, in rows of kPixelListWidth.
BandSample openPixelList(const BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                         std::uint32_t count, FilmPlace film);

/// Traces further passes of a sample in one submission: the camera rays if pass is 0, then `passes` bounces. If no path
/// is left, sets sample.done and adds the rays of the sample to counts.
/// @param then records commands to run after the passes in the same submission
void tracePasses(Device& device, const BandTracer& tracer, BandSample& sample, std::uint32_t passes, RayCounts& counts,
                 const std::function<void(VkCommandBuffer)>& then = {});

/// Whether submitPasses can be used. Not on CPU devices, where tracing and the host share the cores, and not if the
/// time of a submission cannot be measured.
bool canOverlap(const BandTracer& tracer);

/// Passes that the device may still be tracing.
struct PassesInFlight {
    std::uint64_t submission = 0;
    std::uint32_t place = 0, samples = 0; ///< where their counters are, and how many
};

/// As tracePasses, but submits a sample that ends with these passes (endsIn) without waiting for it. All but the last
/// kFramesInFlight - 1 submissions must have been finished before.
PassesInFlight submitPasses(Device& device, BandTracer& tracer, BandSample& sample, std::uint32_t passes,
                            const std::function<void(VkCommandBuffer)>& then = {},
                            Submission submission = Submission::kNow);
/// Waits for these passes, and adds their rays to counts. Returns the seconds that the device took.
double finishPasses(Device& device, const BandTracer& tracer, const PassesInFlight& passes, RayCounts& counts);

/// Whether a sample is known to be done after its camera rays and this many bounces. Deferred rays, from surfaces that
/// reflect and refract, take more passes.
bool endsIn(const BandTracer& tracer, const RenderSettings& settings, std::uint32_t passes);
/// The most rows of this width that the tracer has lanes for.
std::uint32_t fittingRows(const BandTracer& tracer, std::uint32_t width);

} // namespace pointrt
