// SPDX-License-Identifier: Apache-2.0
// A mapped .pro as device buffers.
#pragma once

#include <string>
#include <vector>

#include "format/index/build_index.h"
#include "pointrt/pro.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// One .pro on the device: its splats and its tracing index, all read as texel buffers.
struct DeviceScan {
    std::string path;
    pro_file* file = nullptr;
    pro_info info{};
    pro_view view{};
    pro_index index{};  ///< frame and counts; its pointers hold for an index from the file
    TracingIndex built; ///< of a file without an index, as far as the device reads it here
    Buffer grid_words;  ///< too few for pages (PRO_GRID_WORDS_MAX)
    PagedBuffer splats, brick_words, cells, slabs, near, listed, blending;
    PageCounts pages; ///< of those
    Buffer noise;     ///< bytes; of a clean scan a blank texel
    bool noisy = false;
    std::uint64_t device_bytes = 0;
    std::uint64_t last_used = 0; ///< of a tile: DeviceScene::tile_uses when it was last in a cut
};

/// Maps and validates path, without anything on the device; of a file with an index its view has no octree. Throws
/// Error kBadInput "FILE: reason".
DeviceScan mapScan(const std::string& path);
/// Uploads (or imports) what mapScan gave; of a file without an index that is built. Throws Error: kBadInput "FILE:
/// reason" or kCannotRun. scan is destroyed then.
void uploadScan(Device& device, DeviceScan& scan, bool verbose);
/// Both.
DeviceScan loadScan(Device& device, const std::string& path, bool verbose);
/// A scene of nothing: small buffers for programs that must be given some.
DeviceScan blankScan(Device& device);
/// The buffers, first pages where they have several, at their places in shaders/frame/bindings.glsl.
std::vector<BufferBinding> scanBindings(const DeviceScan& scan);
/// For shaders/frame/pages.glsl.
PagedBuffers pagedBuffers(const DeviceScan& scan);
void destroyScan(Device& device, DeviceScan& scan);

} // namespace pointrt
