// SPDX-License-Identifier: Apache-2.0
// Division of a frame into bands of rows and of bands into strips. The film of one band at a time is on the device; the
// rays of a strip are traced together.
#pragma once

#include <cstdint>

#include "runtime/gpu/device.h"

namespace pointrt {

struct FrameTiling {
    std::uint32_t band_rows = 1, strip_rows = 1;
};

/// Both are multiples of TILE_SIDE, except at the end of the frame.
FrameTiling tilingFor(const Device& device, std::uint32_t width, std::uint32_t height);

/// Number of rows of the next strip of a band, of which `done` rows are done: at most `most`, and either whole tiles
/// (including a partial one at the end of the band) or rows of one tile. This keeps the beam of a tile (beam.comp.glsl)
/// independent of the strips.
std::uint32_t stripRows(std::uint32_t done, std::uint32_t most, std::uint32_t band_rows);

/// Capacity of a BandTracer.
struct TracerSize {
    std::uint32_t lanes = 0;       ///< per strip
    std::uint64_t film_pixels = 0; ///< per band
};

/// The smallest capacity for frames of this width and tiling.
TracerSize tracerSizeFor(FrameTiling tiling, std::uint32_t width);

} // namespace pointrt
