// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/device_scan.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <span>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/base/require_pro.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/device_scene/gaussian_upload.h"
#include "runtime/device_scene/index_cache.h"
#include "runtime/util/on_error.h"

namespace pointrt {

namespace {

/// A section of the file on the device, with the bindings of its first page as texels, of its first page as a storage
/// buffer, and of further pages.
struct ScanBuffer {
    PagedBuffer DeviceScan::*buffer;
    const char* what;
    VkFormat format;
    gpu::Binding first, stored, further;
};
constexpr ScanBuffer kScanBuffers[] = {
    {&DeviceScan::brick_words, "brick buffer", VK_FORMAT_R32_UINT, BINDING_BRICK_WORDS, BINDING_BRICK_STORED,
     BINDING_BRICK_PAGES},
    {&DeviceScan::cells, "cell buffer", VK_FORMAT_R32G32B32A32_UINT, BINDING_CELLS, BINDING_CELL_STORED,
     BINDING_CELL_PAGES},
    {&DeviceScan::slabs, "slab buffer", VK_FORMAT_R32_UINT, BINDING_SLABS, BINDING_SLAB_STORED, BINDING_SLAB_PAGES},
    {&DeviceScan::near, "near splat buffer", VK_FORMAT_R32G32B32A32_UINT, BINDING_NEAR, BINDING_NEAR_STORED,
     BINDING_NEAR_PAGES},
    {&DeviceScan::listed, "listed splat buffer", VK_FORMAT_R32G32_UINT, BINDING_LISTED, BINDING_LISTED_STORED,
     BINDING_LISTED_PAGES},
    {&DeviceScan::blending, "blending splat buffer", VK_FORMAT_R32_UINT, BINDING_BLENDING, BINDING_BLENDING_STORED,
     BINDING_BLENDING_PAGES},
    {&DeviceScan::splats, "splat buffer", VK_FORMAT_R32G32B32A32_UINT, BINDING_SPLATS, BINDING_SPLAT_STORED,
     BINDING_SPLAT_PAGES}};
constexpr std::size_t kIndexBuffers = std::size(kScanBuffers) - 1; // all but the splats, which are last
static_assert(std::equal(std::begin(kScanBuffers), std::end(kScanBuffers), kPagedPlaces.begin(), kPagedPlaces.end(),
                         [](const ScanBuffer& a, const PagedPlace& b) { return a.further == b.further; }));

constexpr std::uint32_t kBlank[4] = {}; // one texel, which may be imported as device memory
constexpr std::uint64_t kTexelBytes = sizeof kBlank;
constexpr std::uint64_t kSplatBytes = PRO_SPLAT_WORDS * sizeof(std::uint32_t);

/// The bytes of a buffer.
struct Section {
    const void* data = nullptr;
    std::uint64_t bytes = 0;
};

/// Size of an array with one byte per splat, rounded up to whole texels; the last page of a section has room for that.
Section noiseOf(DeviceScan& scan) {
    pro_sampling sampling;
    pro_get_sampling(scan.file, &sampling);
    scan.noisy = sampling.noise != nullptr;
    const std::uint64_t texels = (scan.info.splat_count + kTexelBytes - 1) / kTexelBytes;
    return scan.noisy ? Section{sampling.noise, texels * kTexelBytes} : Section{kBlank, kTexelBytes};
}

/// The words of each section, in the order of kScanBuffers.
std::array<std::span<const std::uint32_t>, kIndexBuffers> wordsOf(const pro_index& index) {
    const auto words = [](const std::uint32_t* data, std::uint64_t count, std::uint32_t each) {
        return std::span(data, static_cast<std::size_t>(count * each));
    };
    const std::uint64_t brick_words = std::uint64_t{index.brick_count} * PRO_BRICK_WORDS;
    return {words(index.bricks, brick_words + std::uint64_t{index.group_count} * PRO_GROUP_WORDS, 1),
            words(index.cells, index.cell_count, PRO_CELL_WORDS),
            words(index.slabs, index.cell_count, 1),
            words(index.near_splats, index.near_count, PRO_NEAR_WORDS),
            words(index.listed, index.near_count, 1),
            words(index.blending, index.blending_count / 2, 1)};
}

/// All sections of a scan with its index.
struct Sections {
    std::array<Section, std::size(kScanBuffers)> paged;
    Section grid, noise;
};

Sections sectionsOf(DeviceScan& scan) {
    const pro_index& index = scan.index;
    Sections sections;
    const auto words = wordsOf(index);
    for (std::size_t k = 0; k < kIndexBuffers; ++k) sections.paged[k] = {words[k].data(), words[k].size_bytes()};
    sections.paged[kIndexBuffers] = {scan.view.splats, std::uint64_t{scan.info.splat_count} * kSplatBytes};
    sections.grid = {index.grid, std::uint64_t{index.size[0]} * index.size[1] * index.size[2] * sizeof(std::uint32_t)};
    sections.noise = noiseOf(scan);
    return sections;
}

std::uint64_t pooledBytes(const Device& device, const Sections& sections) {
    std::uint64_t bytes = texelRoom(device, sections.grid.bytes) + texelRoom(device, sections.noise.bytes);
    for (const Section& each : sections.paged) bytes += texelRoom(device, each.bytes);
    return bytes;
}

/// Whether each section fits in a single page.
bool fitPages(const Device& device, const Sections& sections) {
    return std::all_of(sections.paged.begin(), sections.paged.end(), [&](const Section& each) {
        const std::size_t k = static_cast<std::size_t>(&each - sections.paged.data());
        return each.bytes <= texelBytes(kScanBuffers[k].format) << device.page_bits;
    });
}

/// Copies the sections into a range of the device's texel pool. False if they do not fit in one.
bool uploadPooled(Device& device, DeviceScan& scan, const Sections& sections) {
    if (!fitPages(device, sections)) return false;
    scan.range = device.texel_pool->allocate(device, pooledBytes(device, sections));
    if (!scan.range.block) return false;
    TexelPlacer placer(scan.range);
    const auto place = [&](const char* what, const Section& section, VkFormat format) {
        return placer.place(device, what, section.data, section.bytes, format);
    };
    for (std::size_t k = 0; k < std::size(kScanBuffers); ++k)
        (scan.*kScanBuffers[k].buffer).pages = {place(kScanBuffers[k].what, sections.paged[k], kScanBuffers[k].format)};
    scan.grid_words = place("grid buffer", sections.grid, VK_FORMAT_R32_UINT);
    scan.noise = place("noise buffer", sections.noise, VK_FORMAT_R32G32B32A32_UINT);
    return true;
}

void uploadSections(Device& device, DeviceScan& scan, bool pooled) {
    const Sections sections = sectionsOf(scan);
    scan.device_bytes += sections.grid.bytes + (scan.noisy ? sections.noise.bytes : 0);
    for (const Section& each : sections.paged) scan.device_bytes += each.bytes;
    if (pooled && uploadPooled(device, scan, sections)) return;
    for (std::size_t k = 0; k < std::size(kScanBuffers); ++k)
        scan.*kScanBuffers[k].buffer = createPagedBuffer(device, kScanBuffers[k].what, sections.paged[k].data,
                                                         sections.paged[k].bytes, kScanBuffers[k].format);
    scan.grid_words =
        createTexelBuffer(device, "grid buffer", sections.grid.data, sections.grid.bytes, VK_FORMAT_R32_UINT);
    scan.noise = createTexelBuffer(device, "noise buffer", sections.noise.data, sections.noise.bytes,
                                   VK_FORMAT_R32G32B32A32_UINT);
}

/// Builds the index of a file without one. If it can be cached, the cached file replaces the built arrays: the system
/// may reclaim mapped pages.
void buildIndex(DeviceScan& scan, const ScanUpload& how) {
    scan.index_source = IndexSource::kBuilt;
    scan.built = buildTracingIndex(scan.info, scan.view, {how.threads, {}});
    scan.index = indexView(scan.built);
    const FileCache cache = userIndexCache();
    const std::string failure = cacheIndex(cache, scan.file, scan.index);
    scan.cached = failure.empty() ? openCachedIndex(cache, scan.file) : nullptr;
    if (scan.cached && pro_get_index(scan.cached, &scan.index) == 1) scan.built = {};
    if (how.verbose && !failure.empty())
        std::fprintf(stderr, "%s: its index was not cached: %s\n", printable(scan.path).c_str(),
                     printable(failure, std::string::npos).c_str());
}

/// Frees the built arrays that were copied to the device rather than imported, except those that filters read.
void freeBuilt(DeviceScan& scan) {
    Bricks& bricks = scan.built.bricks;
    std::array<Words*, kIndexBuffers> words{&bricks.words, &bricks.cells,  &bricks.slabs,
                                            &bricks.near,  &bricks.listed, &bricks.blending};
    for (std::size_t k = 0; k < words.size(); ++k) {
        const bool is_painted_from = words[k] == &bricks.near || words[k] == &bricks.listed;
        if (is_painted_from || isImported(scan.*kScanBuffers[k].buffer)) continue;
        Words().swap(*words[k]); // assigning {} would keep the memory
    }
    if (!scan.grid_words.imported) Words().swap(scan.built.grid.words);
}

/// A buffer of the elements; a blank texel if `elements` is empty.
template <typename Element>
void uploadTexels(Device& device, DeviceScan& scan, PagedBuffer DeviceScan::*buffer,
                  const std::vector<Element>& elements) {
    const auto* const section = std::find_if(std::begin(kScanBuffers), std::end(kScanBuffers),
                                             [&](const ScanBuffer& each) { return each.buffer == buffer; });
    const bool blank = elements.empty();
    const std::uint64_t bytes = blank ? kTexelBytes : elements.size() * sizeof(Element);
    scan.*buffer = createEmptyPagedBuffer(device, section->what, bytes, section->format);
    uploadPages(device, scan.*buffer, blank ? static_cast<const void*>(kBlank) : elements.data(), bytes, 0);
    scan.device_bytes += bytes;
}

/// Uploads Gaussians to the buffers of a scan.
void uploadGaussians(Device& device, DeviceScan& scan, const pro_gaussians& gaussians) {
    const GaussianBuffers buffers = decodeGaussians(gaussians, scan.view.splats, scan.info.splat_count);
    uploadTexels(device, scan, &DeviceScan::splats, buffers.rows);
    uploadTexels(device, scan, &DeviceScan::near, buffers.nodes);
    uploadTexels(device, scan, &DeviceScan::cells, buffers.harmonics);
    uploadTexels(device, scan, &DeviceScan::brick_words, buffers.lists);
    for (PagedBuffer DeviceScan::*unused : {&DeviceScan::slabs, &DeviceScan::listed, &DeviceScan::blending})
        uploadTexels(device, scan, unused, std::vector<std::uint32_t>());
    scan.grid_words = createTexelBuffer(device, "blank buffer", kBlank, kTexelBytes, VK_FORMAT_R32_UINT);
    scan.noise = createTexelBuffer(device, "blank buffer", kBlank, kTexelBytes, VK_FORMAT_R32G32B32A32_UINT);
    scan.gaussian_box = buffers.box;
    scan.traced_cube = buffers.cube;
    scan.reaches_out = buffers.reaches_out;
    scan.harmonics_degree = gaussians.degree;
    std::copy_n(gaussians.harmonic_max, 3, scan.harmonics_max.begin());
}

/// Whether programs read storage buffers instead of texel buffers: on GPUs, if each buffer is a single page that can be
/// bound as one. CPU devices read texel buffers three times as fast.
bool readsStorage(const Device& device, const DeviceScan& scan) {
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU || isPaged(scan.pages)) return false;
    const std::uint64_t most = device.limits.maxStorageBufferRange;
    return scan.grid_words.bytes <= most &&
           std::all_of(std::begin(kScanBuffers), std::end(kScanBuffers),
                       [&](const ScanBuffer& each) { return (scan.*each.buffer).pages[0].bytes <= most; });
}

/// How programs read the buffers.
void setReads(const Device& device, DeviceScan& scan) {
    scan.pages = pageCounts(device, pagedBuffers(scan));
    scan.reads_storage = readsStorage(device, scan);
}

/// Builds the boxes for ray queries over a scan without pages.
void addCellTree(Device& device, DeviceScan& scan, const ScanUpload& how) {
    const bool is_paged = isPaged(pageCounts(device, pagedBuffers(scan)));
    if (!device.queries_rays || !how.queries_rays || is_paged || !fitsCellTree(device, scan.index.cell_count)) return;
    scan.tree = createCellTree(device, scan.index);
    scan.device_bytes += bytesOf(scan.tree);
    scan.queries_rays = true;
}

/// Uploads everything that the device reads. Errors name the file.
void upload(Device& device, DeviceScan& scan, const ScanUpload& how) {
    pro_gaussians gaussians;
    try {
        if (pro_get_gaussians(scan.file, &gaussians) == 1) {
            uploadGaussians(device, scan, gaussians);
            return setReads(device, scan);
        }
        if (pro_get_index(scan.cached ? scan.cached : scan.file, &scan.index) == 0) buildIndex(scan, how);
        uploadSections(device, scan, how.pooled);
        addCellTree(device, scan, how);
        freeBuilt(scan);
    } catch (const Error& error) {
        throw Error(error.code, scan.path + ": " + error.what());
    }
    setReads(device, scan);
}

const char* sourceWord(IndexSource source) {
    return source == IndexSource::kFile ? "from the file" : source == IndexSource::kCached ? "cached" : "built";
}

} // namespace

DeviceScan mapScan(const std::string& path) {
    requirePro(path);
    DeviceScan scan;
    scan.path = path;
    pro_message message{};
    const pro_result result = pro_open(path.c_str(), PRO_OPEN_TRACE, &scan.file, &message);
    if (result != PRO_OK) throw Error(exitCodeOf(result), path + ": " + message.text);
    pro_get_info(scan.file, &scan.info);
    pro_get_view(scan.file, &scan.view);
    pro_gaussians gaussians;
    scan.is_gaussian = pro_get_gaussians(scan.file, &gaussians) == 1;
    return scan;
}

DeviceScan mapTracedScan(const std::string& path) {
    DeviceScan scan = mapScan(path);
    pro_index index;
    pro_gaussians gaussians;
    if (pro_get_index(scan.file, &index) == 1 || pro_get_gaussians(scan.file, &gaussians) == 1) return scan;
    try {
        scan.cached = openCachedIndex(userIndexCache(), scan.file);
    } catch (...) {
        pro_close(scan.file);
        throw;
    }
    if (scan.cached) scan.index_source = IndexSource::kCached;
    return scan;
}

void uploadScan(Device& device, DeviceScan& scan, const ScanUpload& how) {
    const OnError undo([&] { destroyScan(device, scan); });
    upload(device, scan, how);
    if (how.verbose && scan.is_gaussian)
        std::fprintf(stderr, "%s: %u Gaussians, harmonics of degree %u\n", printable(scan.path).c_str(),
                     scan.info.splat_count, scan.harmonics_degree);
    else if (how.verbose)
        std::fprintf(stderr, "%s: %u splats, %s%s, tracing index %s, entry grid of %u x %u x %u cells\n",
                     printable(scan.path).c_str(), scan.info.splat_count,
                     isImported(scan.splats) ? "mapped pages imported" : "sections uploaded",
                     isPaged(scan.pages) ? ", in pages" : "", sourceWord(scan.index_source), scan.index.size[0],
                     scan.index.size[1], scan.index.size[2]);
}

DeviceScan loadScan(Device& device, const std::string& path, bool verbose) {
    DeviceScan scan = mapTracedScan(path);
    uploadScan(device, scan, {0, verbose, false, true});
    return scan;
}

DeviceScan blankScan(Device& device) {
    DeviceScan scan;
    const auto blank = [&](VkFormat format) {
        return createTexelBuffer(device, "blank buffer", kBlank, kTexelBytes, format);
    };
    scan.grid_words = blank(VK_FORMAT_R32_UINT);
    scan.noise = blank(VK_FORMAT_R32G32B32A32_UINT);
    for (const ScanBuffer& each : kScanBuffers) (scan.*each.buffer).pages = {blank(each.format)};
    return scan;
}

std::vector<BufferBinding> scanBindings(const DeviceScan& scan) {
    std::vector<BufferBinding> bindings{
        {BINDING_GRID_WORDS, &scan.grid_words}, {BINDING_GRID_STORED, &scan.grid_words}, {BINDING_NOISE, &scan.noise}};
    for (const ScanBuffer& each : kScanBuffers) {
        const Buffer& page = (scan.*each.buffer).pages[0];
        bindings.push_back({each.first, &page});
        // bindings that are not read get the grid, which every device can bind
        bindings.push_back({each.stored, scan.reads_storage ? &page : &scan.grid_words});
    }
    return bindings;
}

std::vector<BufferBinding> blockBindings(const TexelBlock& block) {
    const auto view = [&](VkFormat format) {
        // uint32 pairs are read word by word
        return format == VK_FORMAT_R32G32B32A32_UINT ? &block.quads : &block.words;
    };
    std::vector<BufferBinding> bindings{
        {BINDING_GRID_WORDS, &block.words}, {BINDING_GRID_STORED, &block.words}, {BINDING_NOISE, &block.quads}};
    for (const ScanBuffer& each : kScanBuffers) {
        bindings.push_back({each.first, view(each.format)});
        bindings.push_back({each.stored, &block.words});
    }
    return bindings;
}

void setSectionStarts(const DeviceScan& scan, gpu::PooledTile& tile) {
    const std::uint64_t block = scan.range.block->words.range.offset;
    const auto words = [&](const Buffer& buffer) {
        return static_cast<std::uint32_t>((buffer.range.offset - block) / sizeof(std::uint32_t));
    };
    const auto quads = [&](const Buffer& buffer) { return words(buffer) / 4; };
    tile.words = {words(scan.grid_words), words(scan.brick_words.pages[0]), words(scan.slabs.pages[0]),
                  words(scan.blending.pages[0])};
    tile.quads = {quads(scan.cells.pages[0]), quads(scan.near.pages[0]), quads(scan.splats.pages[0]),
                  quads(scan.noise)};
    tile.listed = {words(scan.listed.pages[0]), 0, 0, 0};
}

PagedBuffers pagedBuffers(const DeviceScan& scan) {
    PagedBuffers buffers{};
    for (std::size_t k = 0; k < buffers.size(); ++k) buffers[k] = &(scan.*kScanBuffers[k].buffer);
    return buffers;
}

void destroyScan(Device& device, DeviceScan& scan) {
    for (const ScanBuffer& each : kScanBuffers) destroyPagedBuffer(device, scan.*each.buffer);
    destroyBuffer(device, scan.grid_words);
    destroyBuffer(device, scan.noise);
    destroyCellTree(device, scan.tree);
    if (scan.range.block) device.texel_pool->free(device, std::exchange(scan.range, {}));
    scan.built = {};
    scan.index = {};
    for (pro_file** file : {&scan.file, &scan.cached})
        if (*file) pro_close(std::exchange(*file, nullptr));
}

} // namespace pointrt
