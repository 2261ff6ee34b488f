// SPDX-License-Identifier: Apache-2.0
// What the device keeps for each pixel of a band while it is traced, and of a film.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

struct FrameBuffers {
    Buffer params, control, queues, paths, hits, surfaces, light_queries, light_masks, deferred, film, first_hits,
        beams, places;
    Buffer blank_sieve; ///< for programs that sift nothing
    std::uint64_t device_bytes = 0;
};

/// Tiles of TILE_SIDE pixels, the last ones padded, and their lanes.
std::uint32_t tilesOf(std::uint32_t width, std::uint32_t rows);
std::uint32_t lanesOf(std::uint32_t width, std::uint32_t rows);

/// Rows of the image that are on the device.
struct Band {
    std::uint32_t first_row = 0, rows = 0;
};

/// A band's pixels in the film on the device, which may hold more than the band.
struct FilmPlace {
    std::uint32_t pixels = 0;      ///< of the film
    std::uint32_t first_pixel = 0; ///< of the band
};

/// For bands of up to so many lanes, in films of up to so many pixels. sifts: with room for sifted lists.
FrameBuffers createFrameBuffers(Device& device, std::uint32_t lanes, std::uint64_t film_pixels, bool sifts);
/// Its film and first hits anew, for so many pixels.
void createFilm(Device& device, FrameBuffers& buffers, std::uint64_t film_pixels);
void destroyFrameBuffers(Device& device, FrameBuffers& buffers);
/// At their places in shaders/lib/bindings.glsl.
std::vector<BufferBinding> frameBindings(const FrameBuffers& buffers);

} // namespace pointrt
