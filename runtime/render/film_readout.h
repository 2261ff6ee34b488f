// SPDX-License-Identifier: Apache-2.0
// Between the film on the device, in sums, and the Film of the host, in means.
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"
#include "runtime/image/film.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Sizes the film's arrays for settings; what no ray hits stays as this leaves it.
void allocateFilm(const RenderSettings& settings, Film& film);
/// What its arrays take.
std::uint64_t filmBytesPerPixel(const RenderSettings& settings);

/// Some rows of a band whose film is on the device, on their way to the host.
struct BandRows {
    Band band;
    std::uint32_t first = 0, rows = 0; ///< of the band
    std::uint32_t film_origin = 0;     ///< the picture's row that the host's film begins with
};

/// The device's sums over samples (at least 1) as means in the film's rows.
void storeLight(Device& device, const FrameBuffers& buffers, const BandRows& rows, std::uint32_t samples, Film& film);

/// The film's rows as sums over samples: the way back, to go on from there.
void restoreLight(Device& device, FrameBuffers& buffers, Band band, std::uint32_t samples, const Film& film);

/// Depth, normal, position (along the ray in double, rounded to float once) and ids of the centre rays.
void storeFirstHits(Device& device, const FrameBuffers& buffers, const BandRows& rows, const DeviceScene& scene,
                    const RenderSettings& settings, const Camera& camera, Film& film);

} // namespace pointrt
