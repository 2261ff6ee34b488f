// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/frame_tiling.h"

#include <algorithm>

#include "runtime/render/frame_buffers.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Largest number of pixels of a band. Each takes about 600 bytes of state, at most 148 of them in any one buffer,
/// which stays well below the 128 MiB that some drivers allow for a storage buffer binding. Larger images are rendered
/// in bands of rows.
constexpr std::uint32_t kBandPixels = 1u << 19;
/// Largest number of pixels of a strip on CPUs, where a band is traced strip by strip; enough to keep all threads busy.
/// With half as many, threads wait for each other for a tenth of a frame (tests/bench/NOTES.md).
constexpr std::uint32_t kStripPixels = 1u << 18;

std::uint32_t wholeTiles(std::uint32_t rows) { return std::max(rows / TILE_SIDE, 1u) * TILE_SIDE; }

} // namespace

FrameTiling tilingFor(const Device& device, std::uint32_t width, std::uint32_t height) {
    FrameTiling tiling;
    tiling.band_rows = tiling.strip_rows = std::min(wholeTiles(kBandPixels / width), height);
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU)
        tiling.strip_rows = std::min(tiling.band_rows, wholeTiles(kStripPixels / width));
    return tiling;
}

std::uint32_t stripRows(std::uint32_t done, std::uint32_t most, std::uint32_t band_rows) {
    const std::uint32_t left = band_rows - done, of_tile = done % TILE_SIDE;
    if (of_tile > 0) return std::min({most, left, TILE_SIDE - of_tile});
    if (most >= left) return left;
    return most < TILE_SIDE ? most : wholeTiles(most);
}

TracerSize tracerSizeFor(FrameTiling tiling, std::uint32_t width) {
    return {lanesOf(width, tiling.strip_rows), std::uint64_t{width} * tiling.band_rows};
}

} // namespace pointrt
