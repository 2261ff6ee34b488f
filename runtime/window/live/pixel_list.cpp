// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/pixel_list.h"

#include <algorithm>
#include <cstring>

namespace pointrt {

RowRange listableRows(PixelSize size, std::uint32_t first) {
    const std::uint32_t fitting = std::max(kMaxListedPixels / size.width / TILE_SIDE * TILE_SIDE, 1u);
    return {first, std::min(first + fitting, size.height)};
}

std::vector<std::uint32_t> pixelsOfRows(PixelSize size, const RowRange& rows) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t top = rows.first; top < rows.end; top += TILE_SIDE)
        for (std::uint32_t left = 0; left < size.width; left += TILE_SIDE)
            for (std::uint32_t y = top; y < std::min(top + TILE_SIDE, rows.end); ++y)
                for (std::uint32_t x = left; x < std::min(left + TILE_SIDE, size.width); ++x)
                    numbers.push_back(y * size.width + x);
    return numbers;
}

void uploadPixelList(Device& device, BandTracer& tracer, PixelSize size, std::span<const std::uint32_t> numbers) {
    std::vector<std::uint32_t> places;
    places.reserve(numbers.size());
    for (const std::uint32_t pixel : numbers) places.push_back(pixel % size.width | pixel / size.width << 16);
    while (places.size() % kPixelListWidth != 0) places.push_back(places.back());
    uploadBuffer(device, tracer.buffers.pixel_list, places.data(), places.size() * sizeof(std::uint32_t));
}

void traceFirstHits(Device& device, BandTracer& tracer, const ReprojectionView& view, std::uint32_t count,
                    const std::function<void(VkCommandBuffer)>& then) {
    const std::uint32_t beyond = view.settings.width * view.settings.height;
    BandSample sample = openPixelList(tracer, view.settings, view.camera, count, {kMaxListedPixels, beyond});
    sample.only_first_hits = true;
    RayCounts rays;
    tracePasses(device, tracer, sample, 0, rays, then);
}

std::uint32_t pixelBudget(PixelSize size, double seconds, const ListCost& cost) {
    const double pixels = double{1} * size.width * size.height;
    const double most = std::min<double>(pixels, kMaxListedPixels) / kCountMargin;
    return static_cast<std::uint32_t>(pixelsFor(seconds, cost, most));
}

bool sameShapes(const std::vector<gpu::Shape>& a, const std::vector<gpu::Shape>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(gpu::Shape)) == 0;
}

} // namespace pointrt
