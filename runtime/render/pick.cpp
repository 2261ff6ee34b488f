// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pick.h"

#include <bit>

#include "runtime/render/frame_params.h"

namespace pointrt {

std::optional<Pick> pickPixel(Device& device, BandTracer& tracer, const RenderSettings& settings, const Camera& camera,
                              std::uint32_t x, std::uint32_t y) {
    const std::uint32_t first = settings.width * y;
    BandSample sample = openBand(tracer, settings, camera, {y, 1}, {settings.width * settings.height, first});
    sample.only_first_hits = true;
    RayCounts rays;
    tracePasses(device, tracer, sample, 0, rays);
    gpu::vec4 hit[FIRST_HIT_VECTORS];
    downloadBuffer(device, tracer.buffers.first_hits, hit, sizeof hit, std::uint64_t{first + x} * sizeof hit);
    if (hit[0].w < 0) return std::nullopt;
    Pick pick;
    pick.splat = std::bit_cast<std::uint32_t>(hit[1].x);
    const auto owner = std::bit_cast<std::uint32_t>(hit[1].y), tile = owner >> HIT_TILE_SHIFT;
    pick.owner = owner & HIT_OWNER_MASK;
    if (tile > 0) pick.tile = tile - 1;
    pick.distance = hit[0].w * tracer.scene->space.scale;
    pick.position =
        centerRayOrigin(settings, camera, x, y) + pick.distance * centerRayDirection(settings, camera, x, y);
    pick.normal = {hit[0].x, hit[0].y, hit[0].z};
    return pick;
}

} // namespace pointrt
