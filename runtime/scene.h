// SPDX-License-Identifier: Apache-2.0
// A mapped .pro as device buffers.
#pragma once

#include <string>
#include <vector>

#include "pointrt/pro.h"
#include "runtime/bricks.h"
#include "runtime/device.h"
#include "runtime/entry_grid.h"
#include "runtime/program.h"
#include "runtime/resources.h"

namespace pointrt {

/// One .pro on the device: sections and what is made of them (bricks and the entry grid), all read as texel buffers.
struct Scene {
    std::string path;
    pro_file* file = nullptr;
    pro_info info{};
    pro_view view{};
    EntryGrid grid_frame; ///< its words, and the bricks, are here only where the device reads them here
    Bricks bricks;
    Buffer splats, grid_words, brick_words, cells, slabs, near, lists, blend_ranges;
    std::uint64_t device_bytes = 0;
};

/// Maps, validates and uploads (or imports) path. Throws Error: kBadInput "FILE: reason" or kCannotRun.
Scene loadScene(Device& device, const std::string& path, bool verbose);
/// A scene of nothing: small buffers for programs that must be given some.
Scene blankScene(Device& device);
/// The buffers at their places in shaders/bindings.glsl.
std::vector<BufferBinding> sceneBindings(const Scene& scene);
void destroyScene(Device& device, Scene& scene);

} // namespace pointrt
