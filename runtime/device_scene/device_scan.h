// SPDX-License-Identifier: Apache-2.0
// A mapped .pro file and its device buffers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/index/build_index.h"
#include "pointrt/pro.h"
#include "runtime/device_scene/cell_tree.h"
#include "runtime/device_scene/gaussian_upload.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/gpu/texel_pool.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {

/// Where the tracing index of a scan comes from: the file, the cache, or built now.
enum class IndexSource : std::uint8_t { kFile, kCached, kBuilt };

/// One .pro on the device: its splats and its tracing index, all read as texel buffers.
struct DeviceScan {
    std::string path;
    pro_file* file = nullptr;
    pro_file* cached = nullptr; ///< the cached file with the index, if the file has none
    IndexSource index_source = IndexSource::kFile;
    pro_info info{};
    pro_view view{};
    pro_index index{};  ///< frame and counts; of an index that was built, only near_splats and listed stay valid
    TracingIndex built; ///< an index that could not be cached; keeps the arrays whose memory the device has imported
    Buffer grid_words;  ///< never needs pages (PRO_GRID_WORDS_MAX)
    PagedBuffer splats, brick_words, cells, slabs, near, listed, blending;
    PageCounts pages;           ///< of those buffers
    bool reads_storage = false; ///< programs read storage buffers instead of texel buffers
    bool queries_rays = false;  ///< rays find their cells by ray queries, not by the walk
    CellTree tree;              ///< the tree for those ray queries
    TexelRange range;           ///< if range.block is set, all buffers lie in this range
    Buffer noise;               ///< a byte per splat; a blank texel if the scan has no noise
    bool noisy = false;
    bool is_gaussian = false; ///< holds Gaussians: the buffers have the contents of gaussian_layout.h, and no index
    TracedCube traced_cube;   ///< of GaussianBuffers
    bool reaches_out = false; ///< whether some Gaussians extend beyond traced_cube
    CubeBox gaussian_box;     ///< the box around them
    std::uint32_t harmonics_degree = 0;   ///< of the Gaussians' colours
    std::array<float, 3> harmonics_max{}; ///< their largest coefficients by degree
    std::uint64_t device_bytes = 0;
};

/// Maps and validates a file; uploads nothing. The view of a file with an index has no octree. Throws Error kBadInput
/// "FILE: reason".
DeviceScan mapScan(const std::string& path);
/// The same, for uploadScan: if the file has no index, also maps its cached index, if any. Throws as mapScan and
/// userIndexCache do.
DeviceScan mapTracedScan(const std::string& path);

struct ScanUpload {
    std::size_t threads = 0; ///< limit for building an index; 0: all cores
    bool verbose = false;
    bool pooled = false;       ///< copy the sections into a block of the device's texel pool, if they fit
    bool queries_rays = false; ///< build the tree for ray queries, if the device supports them
};
/// Uploads or imports a scan from mapTracedScan. Builds and caches an index that is missing. Throws Error kBadInput
/// "FILE: reason" or kCannotRun; scan is destroyed then.
void uploadScan(Device& device, DeviceScan& scan, const ScanUpload& how);
/// mapTracedScan and uploadScan, using all cores, with the tree for ray queries.
DeviceScan loadScan(Device& device, const std::string& path, bool verbose);
/// Blank buffers, for programs whose bindings must not be empty.
DeviceScan blankScan(Device& device);
/// The buffers (the first page of paged ones) for the bindings of shaders/lib/bindings.glsl.
std::vector<BufferBinding> scanBindings(const DeviceScan& scan);
/// Bindings of a block in place of the buffers of one scan, for programs that read all scans in the block.
std::vector<BufferBinding> blockBindings(const TexelBlock& block);
/// Where the buffers of a scan start in its block.
void setSectionStarts(const DeviceScan& scan, gpu::PooledTile& tile);
/// The paged buffers, for shaders/lib/pages.glsl.
PagedBuffers pagedBuffers(const DeviceScan& scan);
void destroyScan(Device& device, DeviceScan& scan);

} // namespace pointrt
