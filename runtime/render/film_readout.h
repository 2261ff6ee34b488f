// SPDX-License-Identifier: Apache-2.0
// Conversion between the film on the device (sums) and the Film on the host (means).
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"
#include "runtime/image/film.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Sizes the arrays of the film for settings and fills them with the values of misses.
void allocateFilm(const RenderSettings& settings, Film& film);
/// Memory of the film's arrays in bytes per pixel.
std::uint64_t filmBytesPerPixel(const RenderSettings& settings);

/// Rows to read back of a band whose film is on the device.
struct BandRows {
    Band band;
    std::uint32_t first = 0, rows = 0; ///< within the band
    std::uint32_t film_origin = 0;     ///< row of the picture where the host's film starts
};

/// Stores the device's sums over samples (at least 1) as means in rows of the film.
void storeLight(Device& device, const FrameBuffers& buffers, const BandRows& rows, std::uint32_t samples, Film& film);

/// The inverse, to resume: uploads rows of the film as sums over samples.
void restoreLight(Device& device, FrameBuffers& buffers, Band band, std::uint32_t samples, const Film& film);

/// Stores depth, normal, position (computed in double, rounded to float once) and ids of the centre rays.
void storeFirstHits(Device& device, const FrameBuffers& buffers, const BandRows& rows, const DeviceScene& scene,
                    const RenderSettings& settings, const Camera& camera, Film& film);

} // namespace pointrt
