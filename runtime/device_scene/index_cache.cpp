// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/index_cache.h"

#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <tuple>

#include "format/index/build_index.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/util/memory_text.h"

namespace pointrt {
namespace {

template <typename T>
T headerField(const pro_file* file, std::size_t offset) {
    T value;
    std::memcpy(&value, static_cast<const std::byte*>(pro_bytes(file, nullptr)) + offset, sizeof value);
    return value;
}

/// Named by the checksum of the header, which includes those of all sections, and by the version of the index builder.
std::string cachedPath(const FileCache& cache, const pro_file* file) {
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/%016" PRIx64 "-%u", headerField<std::uint64_t>(file, PRO_OFF_HEADER_XXH3),
                  kIndexVersion);
    return cache.folder + name.data() + cache.suffix;
}

/// The checksum of a section that every file has. The section table was validated when the file was opened.
std::uint64_t sectionSum(const pro_file* file, std::uint32_t kind) {
    std::size_t record = PRO_TABLE_OFFSET;
    while (headerField<std::uint32_t>(file, record + PRO_SEC_OFF_KIND) != kind) record += PRO_SECTION_BYTES;
    return headerField<std::uint64_t>(file, record + PRO_SEC_OFF_XXH3);
}

/// Whether everything that an index is built from is equal. Compares checksums, so that no more pages of the files are
/// read.
bool isOfSameOctree(const pro_file* a, const pro_file* b) {
    const auto traits = [](const pro_file* file) {
        pro_info info;
        pro_get_info(file, &info);
        const std::array<double, 4> place{info.origin[0], info.origin[1], info.origin[2], info.scale};
        return std::tuple(info.splat_count, info.node_count, info.leaf_count, info.ref_count, info.max_depth,
                          info.radius_max, info.radius_step, info.blend_slab, place);
    };
    const auto same = [&](std::uint32_t kind) { return sectionSum(a, kind) == sectionSum(b, kind); };
    return traits(a) == traits(b) && same(PRO_KIND_NODE) && same(PRO_KIND_LEAF) && same(PRO_KIND_REFS) &&
           same(PRO_KIND_SPLT);
}

/// Aligned parts of a cached file: five sections of splats and octree, seven of the index, and the header.
constexpr std::uint64_t kCachedParts = 13;

/// Upper bound for the size of a cached file: the bytes of the original, of the index, and of alignment.
std::uint64_t cachedBytes(const pro_file* file, const pro_index& index) {
    std::size_t file_bytes = 0;
    pro_bytes(file, &file_bytes);
    const std::uint64_t words = std::uint64_t{index.size[0]} * index.size[1] * index.size[2] +
                                std::uint64_t{index.brick_count} * PRO_BRICK_WORDS +
                                std::uint64_t{index.group_count} * PRO_GROUP_WORDS +
                                std::uint64_t{index.cell_count} * (PRO_CELL_WORDS + 1) +
                                std::uint64_t{index.near_count} * (PRO_NEAR_WORDS + 1) + index.blending_count / 2;
    return file_bytes + words * sizeof(std::uint32_t) + kCachedParts * PRO_SECTION_ALIGNMENT;
}

} // namespace

FileCache userIndexCache() { return userFileCache({"index", ".pro", "POINTRT_INDEX_CACHE", kIndexCacheBytes}); }

pro_file* openCachedIndex(const FileCache& cache, const pro_file* file) {
    if (cache.folder.empty()) return nullptr;
    const std::string path = cachedPath(cache, file);
    pro_file* cached = nullptr;
    if (pro_open(path.c_str(), PRO_OPEN_TRACE, &cached, nullptr) != PRO_OK) return nullptr;
    pro_index index;
    if (pro_get_index(cached, &index) == 1 && isOfSameOctree(cached, file)) {
        markUsed(path);
        return cached;
    }
    pro_close(cached);
    return nullptr;
}

std::string cacheIndex(const FileCache& cache, const pro_file* file, const pro_index& index) {
    if (cache.folder.empty()) return "the index cache is off or has no folder";
    const std::uint64_t bytes = cachedBytes(file, index);
    if (!makeRoomFor(cache, bytes)) return cache.folder + " has no room for " + mebibytes(bytes);
    pro_info info;
    pro_view view;
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    view.order = nullptr; // not needed in the cache
    view.metadata_bytes = 0;
    pro_message message{};
    const std::string path = cachedPath(cache, file);
    if (pro_write_indexed(path.c_str(), &info, &view, &index, &message) == PRO_OK) return {};
    return path + ": " + message.text;
}

} // namespace pointrt
