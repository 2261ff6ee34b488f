// SPDX-License-Identifier: Apache-2.0
// How a frame is cut: into bands of rows, whose film is on the device one at a time, and those into strips, whose rays
// are under way together.
#pragma once

#include <cstdint>

#include "runtime/gpu/device.h"

namespace pointrt {

struct FrameTiling {
    std::uint32_t band_rows = 1, strip_rows = 1;
};

/// Both are whole tiles of TILE_SIDE, but where the frame ends.
FrameTiling tilingFor(const Device& device, std::uint32_t width, std::uint32_t height);

/// Rows of the next strip of a band of which so many are done: at most so many, and either whole tiles, to which what
/// is left at the band's end belongs, or rows of one. So a tile's beam (beam.comp.glsl) is the same in whatever strips.
std::uint32_t stripRows(std::uint32_t done, std::uint32_t most, std::uint32_t band_rows);

/// What a BandTracer has room for.
struct TracerSize {
    std::uint32_t lanes = 0;       ///< of a strip
    std::uint64_t film_pixels = 0; ///< of a band
};

/// The least for frames of this width that are cut so.
TracerSize tracerSizeFor(FrameTiling tiling, std::uint32_t width);

} // namespace pointrt
