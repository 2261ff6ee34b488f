// SPDX-License-Identifier: Apache-2.0
#include "header.h"

#include <bit>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointrt::format {

// Views are the file's own bytes, so a big-endian host could not use them whatever the header loads did.
static_assert(std::endian::native == std::endian::little, ".pro files are used in place: little-endian hosts only");

namespace {

template <typename T>
T load(const std::byte* bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes + offset, sizeof value);
    return value;
}

template <typename T>
void store(std::byte* bytes, std::size_t offset, const T& value) {
    std::memcpy(bytes + offset, &value, sizeof value);
}

} // namespace

std::uint32_t loadU32(const std::byte* bytes, std::size_t offset) { return load<std::uint32_t>(bytes, offset); }
std::uint64_t loadU64(const std::byte* bytes, std::size_t offset) { return load<std::uint64_t>(bytes, offset); }
void storeU32(std::byte* bytes, std::size_t offset, std::uint32_t value) { store(bytes, offset, value); }
void storeU64(std::byte* bytes, std::size_t offset, std::uint64_t value) { store(bytes, offset, value); }

const KindRule* findRule(std::uint32_t kind) {
    for (const KindRule& rule : kKindRules)
        if (rule.kind == kind) return &rule;
    return nullptr;
}

std::array<char, 5> kindName(std::uint32_t kind) {
    std::array<char, 5> name{};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto c = static_cast<char>(kind >> (8 * i) & 0xFF);
        name[i] = c > ' ' && c <= '~' ? c : '?';
    }
    return name;
}

std::uint64_t promisedCount(std::uint32_t kind, const pro_info& info, const pro_view& view) {
    switch (kind) {
    case PRO_KIND_NODE:
        return info.node_count;
    case PRO_KIND_LEAF:
        return info.leaf_count;
    case PRO_KIND_REFS:
        return info.ref_count;
    case PRO_KIND_SPLT:
    case PRO_KIND_ORDR:
        return info.splat_count;
    case PRO_KIND_MATL:
        return info.material_count;
    default:
        return view.metadata_bytes;
    }
}

void setSection(pro_view& view, std::uint32_t kind, const std::byte* data, std::uint64_t count) {
    const void* start = data;
    switch (kind) {
    case PRO_KIND_NODE:
        view.nodes = static_cast<const std::uint32_t*>(start);
        break;
    case PRO_KIND_LEAF:
        view.leaves = static_cast<const std::uint32_t*>(start);
        break;
    case PRO_KIND_REFS:
        view.refs = static_cast<const std::uint32_t*>(start);
        break;
    case PRO_KIND_SPLT:
        view.splats = static_cast<const std::uint32_t*>(start);
        break;
    case PRO_KIND_MATL:
        view.materials = static_cast<const float*>(start);
        break;
    case PRO_KIND_ORDR:
        view.order = static_cast<const std::uint32_t*>(start);
        break;
    case PRO_KIND_META:
        view.metadata = static_cast<const char*>(start);
        view.metadata_bytes = count;
        break;
    default:
        break;
    }
}

const void* sectionData(const pro_view& view, std::uint32_t kind) {
    switch (kind) {
    case PRO_KIND_NODE:
        return view.nodes;
    case PRO_KIND_LEAF:
        return view.leaves;
    case PRO_KIND_REFS:
        return view.refs;
    case PRO_KIND_SPLT:
        return view.splats;
    case PRO_KIND_MATL:
        return view.materials;
    case PRO_KIND_ORDR:
        return view.order;
    case PRO_KIND_META:
        return view.metadata;
    default:
        return nullptr;
    }
}

pro_info loadInfo(const std::byte* header) {
    pro_info info{};
    info.version_major = loadU32(header, PRO_OFF_VERSION_MAJOR);
    info.version_minor = loadU32(header, PRO_OFF_VERSION_MINOR);
    info.file_bytes = loadU64(header, PRO_OFF_FILE_BYTES);
    info.flags = loadU32(header, PRO_OFF_FLAGS);
    info.max_depth = loadU32(header, PRO_OFF_MAX_DEPTH);
    info.splat_count = loadU32(header, PRO_OFF_SPLAT_COUNT);
    info.node_count = loadU32(header, PRO_OFF_NODE_COUNT);
    info.leaf_count = loadU32(header, PRO_OFF_LEAF_COUNT);
    info.ref_count = loadU32(header, PRO_OFF_REF_COUNT);
    info.material_count = loadU32(header, PRO_OFF_MATERIAL_COUNT);
    info.radius_max = load<float>(header, PRO_OFF_RADIUS_MAX);
    info.radius_step = load<float>(header, PRO_OFF_RADIUS_STEP);
    info.blend_slab = load<float>(header, PRO_OFF_BLEND_SLAB);
    info.scale = load<double>(header, PRO_OFF_SCALE);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        info.origin[axis] = load<double>(header, PRO_OFF_ORIGIN + 8 * axis);
        info.bounds_min[axis] = load<double>(header, PRO_OFF_BOUNDS_MIN + 8 * axis);
        info.bounds_max[axis] = load<double>(header, PRO_OFF_BOUNDS_MAX + 8 * axis);
    }
    return info;
}

void storeInfo(std::byte* header, const pro_info& info) {
    storeU32(header, PRO_OFF_MAGIC, PRO_MAGIC_WORD0);
    storeU32(header, PRO_OFF_MAGIC + 4, PRO_MAGIC_WORD1);
    storeU32(header, PRO_OFF_VERSION_MAJOR, info.version_major);
    storeU32(header, PRO_OFF_VERSION_MINOR, info.version_minor);
    storeU64(header, PRO_OFF_FILE_BYTES, info.file_bytes);
    storeU32(header, PRO_OFF_FLAGS, info.flags);
    storeU32(header, PRO_OFF_MAX_DEPTH, info.max_depth);
    storeU32(header, PRO_OFF_SPLAT_COUNT, info.splat_count);
    storeU32(header, PRO_OFF_NODE_COUNT, info.node_count);
    storeU32(header, PRO_OFF_LEAF_COUNT, info.leaf_count);
    storeU32(header, PRO_OFF_REF_COUNT, info.ref_count);
    storeU32(header, PRO_OFF_MATERIAL_COUNT, info.material_count);
    store(header, PRO_OFF_RADIUS_MAX, info.radius_max);
    store(header, PRO_OFF_RADIUS_STEP, info.radius_step);
    store(header, PRO_OFF_BLEND_SLAB, info.blend_slab);
    store(header, PRO_OFF_SCALE, info.scale);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        store(header, PRO_OFF_ORIGIN + 8 * axis, info.origin[axis]);
        store(header, PRO_OFF_BOUNDS_MIN + 8 * axis, info.bounds_min[axis]);
        store(header, PRO_OFF_BOUNDS_MAX + 8 * axis, info.bounds_max[axis]);
    }
}

Section loadSection(const std::byte* header, std::uint32_t index) {
    const std::byte* record = header + PRO_TABLE_OFFSET + std::size_t{index} * PRO_SECTION_BYTES;
    Section section;
    section.kind = loadU32(record, PRO_SEC_OFF_KIND);
    section.stride = loadU32(record, PRO_SEC_OFF_STRIDE);
    section.count = loadU64(record, PRO_SEC_OFF_COUNT);
    section.offset = loadU64(record, PRO_SEC_OFF_OFFSET);
    section.length = loadU64(record, PRO_SEC_OFF_LENGTH);
    section.xxh3 = loadU64(record, PRO_SEC_OFF_XXH3);
    section.flags = loadU32(record, PRO_SEC_OFF_FLAGS);
    return section;
}

void storeSection(std::byte* header, std::uint32_t index, const Section& section) {
    std::byte* record = header + PRO_TABLE_OFFSET + std::size_t{index} * PRO_SECTION_BYTES;
    storeU32(record, PRO_SEC_OFF_KIND, section.kind);
    storeU32(record, PRO_SEC_OFF_STRIDE, section.stride);
    storeU64(record, PRO_SEC_OFF_COUNT, section.count);
    storeU64(record, PRO_SEC_OFF_OFFSET, section.offset);
    storeU64(record, PRO_SEC_OFF_LENGTH, section.length);
    storeU64(record, PRO_SEC_OFF_XXH3, section.xxh3);
    storeU32(record, PRO_SEC_OFF_FLAGS, section.flags);
}

std::uint64_t checksum(const void* data, std::size_t bytes) { return XXH3_64bits(data, bytes); }

std::uint64_t headerChecksum(const std::byte* header) {
    return checksum(header + PRO_OFF_SECTION_COUNT, PRO_HEADER_BYTES - PRO_OFF_SECTION_COUNT);
}

} // namespace pointrt::format
