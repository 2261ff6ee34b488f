// SPDX-License-Identifier: Apache-2.0
// A mapped .pro as device buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/index/build_index.h"
#include "pointrt/pro.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Where the tracing index of a scan is from.
enum class IndexSource : std::uint8_t { kFile, kKept, kBuilt };

/// One .pro on the device: its splats and its tracing index, all read as texel buffers.
struct DeviceScan {
    std::string path;
    pro_file* file = nullptr;
    pro_file* kept = nullptr; ///< of a file without an index: that with the index that is kept for it, if any
    IndexSource index_source = IndexSource::kFile;
    pro_info info{};
    pro_view view{};
    pro_index index{};  ///< frame and counts; its pointers hold for an index from a file
    TracingIndex built; ///< of a file without an index that cannot be kept, as far as the device reads it here
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
/// The same for who uploads it: of a file without an index with the one that is kept for it. Throws as mapScan and
/// userIndexStore do.
DeviceScan mapTracedScan(const std::string& path);

struct ScanUpload {
    std::size_t threads = 0; ///< that build an index, at most; 0: all cores
    bool verbose = false;
};
/// Uploads (or imports) what mapTracedScan gave; of a file without an index that is built, and kept. Throws Error:
/// kBadInput "FILE: reason" or kCannotRun. scan is destroyed then.
void uploadScan(Device& device, DeviceScan& scan, const ScanUpload& how);
/// Both, on all cores.
DeviceScan loadScan(Device& device, const std::string& path, bool verbose);
/// A scene of nothing: small buffers for programs that must be given some.
DeviceScan blankScan(Device& device);
/// The buffers, first pages where they have several, at their places in shaders/lib/bindings.glsl.
std::vector<BufferBinding> scanBindings(const DeviceScan& scan);
/// For shaders/lib/pages.glsl.
PagedBuffers pagedBuffers(const DeviceScan& scan);
void destroyScan(Device& device, DeviceScan& scan);

} // namespace pointrt
