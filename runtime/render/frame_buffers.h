// SPDX-License-Identifier: Apache-2.0
// Device buffers of a band being traced, and of the film.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

struct FrameBuffers {
    Buffer params, control, queues, paths, hits, surfaces, light_queries, light_masks, deferred, film, first_hits,
        beams, pixel_list, gaussian_light, waiting_gaussians;
    Buffer no_cull_boxes; ///< bound in programs that cull nothing
    /// Copies for the host of the control buffer, after each of kSamplesAtOnce samples in each of kFramesInFlight
    /// submissions.
    Buffer control_read;
    std::uint32_t lanes = 0;
    std::uint64_t film_pixels = 0;
    std::uint32_t film_layers = 0; ///< number of layers (filmLayers) for the most samples that the film has room for
    std::uint64_t device_bytes = 0;
};

/// Limit for the samples in one submission; each part of a band counts separately.
constexpr std::uint32_t kSamplesAtOnce = 64;

/// Number of tiles of TILE_SIDE x TILE_SIDE pixels, the last ones padded, and of their lanes.
std::uint32_t tilesOf(std::uint32_t width, std::uint32_t rows);
std::uint32_t lanesOf(std::uint32_t width, std::uint32_t rows);

/// Rows of the image that are on the device.
struct Band {
    std::uint32_t first_row = 0, rows = 0;
};

/// Position of a band in the film on the device, which may hold more than the band.
struct FilmPlace {
    std::uint32_t pixels = 0;      ///< size of the film
    std::uint32_t first_pixel = 0; ///< index in the film of the first pixel of the band
};

/// The largest film that buffers have room for.
struct FilmRoom {
    std::uint64_t pixels = 0;
    std::uint32_t samples = 1; ///< per pixel
};

/// The number of layers of a film: those of one batch of samples, twice as many if there may be earlier batches.
std::uint32_t filmLayers(std::uint32_t samples);

/// Which Gaussians rays may pass through: none, those of one instance, or of several.
enum class GaussianRoom { kNone, kOne, kSeveral };

/// Buffers for bands of up to `lanes` lanes. culls: also make room for culled lists.
FrameBuffers createFrameBuffers(Device& device, std::uint32_t lanes, FilmRoom film, bool culls, GaussianRoom gaussians);
/// Reallocates the film and the first hits.
void createFilm(Device& device, FrameBuffers& buffers, FilmRoom film);
/// Reallocates the film, keeping its contents, if it has no room for this many samples. Returns whether it did.
bool extendFilm(Device& device, FrameBuffers& buffers, std::uint32_t samples);
void destroyFrameBuffers(Device& device, FrameBuffers& buffers);
/// Bindings as in shaders/lib/bindings.glsl.
std::vector<BufferBinding> frameBindings(const FrameBuffers& buffers);

} // namespace pointrt
