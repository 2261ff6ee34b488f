// SPDX-License-Identifier: Apache-2.0
// The list of pixels that are traced for the render cache.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "runtime/window/live/reprojector.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// The number of pixels selected at random may exceed the requested number by this factor.
constexpr double kCountMargin = 1.125;

/// Rows of pixels: [first, end).
struct RowRange {
    std::uint32_t first = 0, end = 0;
};

/// Rows from first on whose first hits fit in the list: whole rows of tiles if they fit.
RowRange listableRows(PixelSize size, std::uint32_t first);
/// The numbers of their pixels, tile by tile.
std::vector<std::uint32_t> pixelsOfRows(PixelSize size, const RowRange& rows);

/// Uploads x | y << 16 of each pixel, padded to complete rows.
void uploadPixelList(Device& device, BandTracer& tracer, PixelSize size, std::span<const std::uint32_t> numbers);

/// Traces the first hits of the first count listed pixels, and stores these after the first hits of the full frame.
/// @param then records commands to run in the same submission
void traceFirstHits(Device& device, BandTracer& tracer, const ReprojectionView& view, std::uint32_t count,
                    const std::function<void(VkCommandBuffer)>& then = {});

/// Number of pixels to trace in a frame of this many seconds.
std::uint32_t pixelBudget(PixelSize size, double seconds, const ListCost& cost);

bool sameShapes(const std::vector<gpu::Shape>& a, const std::vector<gpu::Shape>& b);

} // namespace pointrt
