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
        beams, pixel_list;
    Buffer no_cull_boxes; ///< for programs that cull nothing
    std::uint64_t device_bytes = 0;
};

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

/// Buffers for bands of up to `lanes` lanes, and films of up to film_pixels pixels. culls: with room for culled lists.
FrameBuffers createFrameBuffers(Device& device, std::uint32_t lanes, std::uint64_t film_pixels, bool culls);
/// Reallocates the film and the first hits for film_pixels pixels.
void createFilm(Device& device, FrameBuffers& buffers, std::uint64_t film_pixels);
void destroyFrameBuffers(Device& device, FrameBuffers& buffers);
/// Bindings as in shaders/lib/bindings.glsl.
std::vector<BufferBinding> frameBindings(const FrameBuffers& buffers);

} // namespace pointrt
