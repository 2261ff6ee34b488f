// SPDX-License-Identifier: Apache-2.0
// A mapped .pro as device buffers.
#pragma once

#include <string>
#include <vector>

#include "format/index/build_index.h"
#include "pointrt/pro.h"
#include "runtime/device.h"
#include "runtime/paged_buffer.h"
#include "runtime/program.h"
#include "runtime/resources.h"

namespace pointrt {

/// One .pro on the device: its splats and its tracing index, all read as texel buffers.
struct Scene {
    std::string path;
    pro_file* file = nullptr;
    pro_info info{};
    pro_view view{};
    pro_index index{};  ///< frame and counts; its pointers hold for an index from the file
    TracingIndex built; ///< of a file without an index, as far as the device reads it here
    Buffer grid_words;  ///< too few for pages (PRO_GRID_WORDS_MAX)
    PagedBuffer splats, brick_words, cells, slabs, near, lists, blend_ranges;
    PageCounts pages; ///< of those
    std::uint64_t device_bytes = 0;
};

/// Maps, validates and uploads (or imports) path; of a file with an index its view has no octree, of one without the
/// index is built. Throws Error: kBadInput "FILE: reason" or kCannotRun.
Scene loadScene(Device& device, const std::string& path, bool verbose);
/// A scene of nothing: small buffers for programs that must be given some.
Scene blankScene(Device& device);
/// The buffers, first pages where they have several, at their places in shaders/bindings.glsl.
std::vector<BufferBinding> sceneBindings(const Scene& scene);
/// For shaders/pages.glsl.
PagedBuffers pagedBuffers(const Scene& scene);
void destroyScene(Device& device, Scene& scene);

} // namespace pointrt
