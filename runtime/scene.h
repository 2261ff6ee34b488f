// SPDX-License-Identifier: Apache-2.0
// A mapped .pro as device buffers.
#pragma once

#include <string>

#include "pointrt/pro.h"
#include "runtime/device.h"
#include "runtime/resources.h"

namespace pointrt {

/// The sections of one .pro on the device, read there as texel buffers, and the entry grid over its octree.
struct Scene {
    std::string path;
    pro_file* file = nullptr;
    pro_info info{};
    pro_view view{};
    Buffer nodes, leaves, refs, splats, materials, grid;
    std::uint32_t grid_bits = 0; ///< the grid has 2^grid_bits cells a side
    std::uint64_t device_bytes = 0;
};

/// Maps, validates and uploads (or imports) path. Throws Error: kBadInput "FILE: reason" or kCannotRun.
Scene loadScene(Device& device, const std::string& path, bool verbose);
void destroyScene(Device& device, Scene& scene);

} // namespace pointrt
