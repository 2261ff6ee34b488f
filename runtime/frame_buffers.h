// SPDX-License-Identifier: Apache-2.0
// What the device keeps for each pixel of a band while it is traced.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/program.h"
#include "runtime/resources.h"

namespace pointrt {

struct FrameBuffers {
    Buffer params, control, queues, paths, hits, surfaces, lit, light_masks, deferred, film, first_hits, beams;
    std::uint64_t device_bytes = 0;
};

/// Tiles of TILE_SIDE pixels, the last ones padded, and their lanes.
std::uint32_t tilesOf(std::uint32_t width, std::uint32_t rows);
std::uint32_t lanesOf(std::uint32_t width, std::uint32_t rows);

FrameBuffers createFrameBuffers(Device& device, std::uint32_t width, std::uint32_t rows);
void destroyFrameBuffers(Device& device, FrameBuffers& buffers);
/// At their places in shaders/bindings.glsl.
std::vector<BufferBinding> frameBindings(const FrameBuffers& buffers);

} // namespace pointrt
