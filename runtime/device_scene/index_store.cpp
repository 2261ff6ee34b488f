// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/index_store.h"

#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <tuple>

#include "format/base/error.h"
#include "format/index/build_index.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/util/available_memory.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kSize = "POINTRT_INDEX_CACHE";

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// "" where the user has none. Relative ones are to be passed over, the XDG base directory specification says.
std::string cacheFolder() {
    if (const std::string cache = variable("XDG_CACHE_HOME"); cache.starts_with('/')) return cache;
    const std::string home = variable("HOME");
    return home.starts_with('/') ? home + "/.cache" : "";
}

template <typename T>
T headerField(const pro_file* file, std::size_t offset) {
    T value;
    std::memcpy(&value, static_cast<const std::byte*>(pro_bytes(file, nullptr)) + offset, sizeof value);
    return value;
}

/// By the sum of the header, of which those of all sections are a part, and by who builds indices.
std::string keptPath(const KeptFiles& store, const pro_file* file) {
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/%016" PRIx64 "-%u", headerField<std::uint64_t>(file, PRO_OFF_HEADER_XXH3),
                  kIndexVersion);
    return store.folder + name.data() + store.suffix;
}

/// Of a section that every file has; the file was opened, so that its table is sound.
std::uint64_t sectionSum(const pro_file* file, std::uint32_t kind) {
    std::size_t record = PRO_TABLE_OFFSET;
    while (headerField<std::uint32_t>(file, record + PRO_SEC_OFF_KIND) != kind) record += PRO_SECTION_BYTES;
    return headerField<std::uint64_t>(file, record + PRO_SEC_OFF_XXH3);
}

/// Whether all that an index is made of is the same, by sums: no page of the files is touched again.
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

/// Sections of a kept file, five of splats and octree and seven of the index, and its header.
constexpr std::uint64_t kKeptParts = 13;

/// Of the kept file, at most: the other's bytes, the index's, and what aligns them.
std::uint64_t keptBytes(const pro_file* file, const pro_index& index) {
    std::size_t file_bytes = 0;
    pro_bytes(file, &file_bytes);
    const std::uint64_t words = std::uint64_t{index.size[0]} * index.size[1] * index.size[2] +
                                std::uint64_t{index.brick_count} * PRO_BRICK_WORDS +
                                std::uint64_t{index.group_count} * PRO_GROUP_WORDS +
                                std::uint64_t{index.cell_count} * (PRO_CELL_WORDS + 1) +
                                std::uint64_t{index.near_count} * (PRO_NEAR_WORDS + 1) + index.blending_count / 2;
    return file_bytes + words * sizeof(std::uint32_t) + kKeptParts * PRO_SECTION_ALIGNMENT;
}

} // namespace

KeptFiles userIndexStore() {
    KeptFiles store{cacheFolder(), ".pro", kIndexStoreBytes};
    const std::string size = variable(kSize);
    if (size == "off") store.folder.clear();
    if (!store.folder.empty()) store.folder += "/pointrt/index";
    if (size.empty() || size == "off") return store;
    try {
        store.most_bytes = parseBytes(size);
    } catch (const std::invalid_argument& error) {
        throw Error(ExitCode::kBadUsage, std::string(kSize) + ": " + error.what() + ", or off");
    }
    return store;
}

pro_file* openKeptIndex(const KeptFiles& store, const pro_file* file) {
    if (store.folder.empty()) return nullptr;
    const std::string path = keptPath(store, file);
    pro_file* kept = nullptr;
    if (pro_open(path.c_str(), PRO_OPEN_TRACE, &kept, nullptr) != PRO_OK) return nullptr;
    pro_index index;
    if (pro_get_index(kept, &index) == 1 && isOfSameOctree(kept, file)) {
        markUsed(path);
        return kept;
    }
    pro_close(kept);
    return nullptr;
}

std::string keepIndex(const KeptFiles& store, const pro_file* file, const pro_index& index) {
    if (store.folder.empty()) return "nothing is to be kept";
    const std::uint64_t bytes = keptBytes(file, index);
    if (!makeRoomFor(store, bytes)) return store.folder + " has no room for " + mebibytes(bytes);
    pro_info info;
    pro_view view;
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    view.order = nullptr; // nobody asks for them there
    view.metadata_bytes = 0;
    pro_message message{};
    const std::string path = keptPath(store, file);
    if (pro_write_indexed(path.c_str(), &info, &view, &index, &message) == PRO_OK) return {};
    return path + ": " + message.text;
}

} // namespace pointrt
