// SPDX-License-Identifier: Apache-2.0
#include "format/pro/header.h"

#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

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

namespace {

constexpr std::uint32_t kPair = 2; ///< near splats, and numbers of what blends, of an element
constexpr std::uint32_t kBrickGroups = PRO_BRICK_WORDS / PRO_GROUP_WORDS;

/// Calls visit(field) for a known kind, where field(content) is the section's pointer in a Content.
template <typename Visit>
void visitPointer(std::uint32_t kind, Visit&& visit) {
    switch (kind) {
    case PRO_KIND_NODE:
        return visit([](auto& content) -> auto& { return content.view.nodes; });
    case PRO_KIND_LEAF:
        return visit([](auto& content) -> auto& { return content.view.leaves; });
    case PRO_KIND_REFS:
        return visit([](auto& content) -> auto& { return content.view.refs; });
    case PRO_KIND_SPLT:
        return visit([](auto& content) -> auto& { return content.view.splats; });
    case PRO_KIND_MATL:
        return visit([](auto& content) -> auto& { return content.view.materials; });
    case PRO_KIND_ORDR:
        return visit([](auto& content) -> auto& { return content.view.order; });
    case PRO_KIND_META:
        return visit([](auto& content) -> auto& { return content.view.metadata; });
    case PRO_KIND_ENTR:
        return visit([](auto& content) -> auto& { return content.index.grid; });
    case PRO_KIND_BRKS:
        return visit([](auto& content) -> auto& { return content.index.bricks; });
    case PRO_KIND_CELS:
        return visit([](auto& content) -> auto& { return content.index.cells; });
    case PRO_KIND_SLBS:
        return visit([](auto& content) -> auto& { return content.index.slabs; });
    case PRO_KIND_DSCS:
        return visit([](auto& content) -> auto& { return content.index.near_splats; });
    case PRO_KIND_DSPL:
        return visit([](auto& content) -> auto& { return content.index.listed; });
    case PRO_KIND_BLDS:
        return visit([](auto& content) -> auto& { return content.index.blending; });
    case PRO_KIND_NOIS:
        return visit([](auto& content) -> auto& { return content.sampling.noise; });
    case PRO_KIND_SENS:
        return visit([](auto& content) -> auto& { return content.world.sensors; });
    case PRO_KIND_ATTD:
        return visit([](auto& content) -> auto& { return content.attribute_records; });
    default:
        return;
    }
}

} // namespace

std::uint64_t elementCount(std::uint32_t kind, const pro_info& info, const Content& content) {
    const pro_index& index = content.index;
    switch (kind) {
    case PRO_KIND_NODE:
        return info.node_count;
    case PRO_KIND_LEAF:
        return info.leaf_count;
    case PRO_KIND_REFS:
        return info.ref_count;
    case PRO_KIND_SPLT:
    case PRO_KIND_ORDR:
    case PRO_KIND_NOIS:
        return info.splat_count;
    case PRO_KIND_MATL:
        return info.material_count;
    case PRO_KIND_ENTR:
        return gridWords(index);
    case PRO_KIND_BRKS:
        return std::uint64_t{index.brick_count} * kBrickGroups + index.group_count;
    case PRO_KIND_CELS:
    case PRO_KIND_SLBS:
        return index.cell_count;
    case PRO_KIND_DSCS:
    case PRO_KIND_DSPL:
        return index.near_count / kPair;
    case PRO_KIND_BLDS:
        return index.blending_count / kPair;
    case PRO_KIND_SENS:
        return content.world.sensor_count;
    case PRO_KIND_ATTD:
        return content.attribute_count;
    default:
        return content.view.metadata_bytes;
    }
}

void setSection(Content& content, std::uint32_t kind, const std::byte* data, std::uint64_t count) {
    visitPointer(kind, [&](auto field) {
        auto& pointer = field(content);
        pointer = static_cast<std::remove_reference_t<decltype(pointer)>>(static_cast<const void*>(data));
    });
    pro_index& index = content.index;
    const auto words = static_cast<std::uint32_t>(count);
    if (kind == PRO_KIND_META) content.view.metadata_bytes = count;
    if (kind == PRO_KIND_BRKS) index.group_count = words - index.brick_count * kBrickGroups;
    if (kind == PRO_KIND_CELS) index.cell_count = words;
    if (kind == PRO_KIND_DSCS) index.near_count = words * kPair;
    if (kind == PRO_KIND_BLDS) index.blending_count = words * kPair;
    if (kind == PRO_KIND_SENS) content.world.sensor_count = words;
    if (kind == PRO_KIND_ATTD) content.attribute_count = count;
}

const void* sectionData(const Content& content, std::uint32_t kind) {
    const void* data = nullptr;
    visitPointer(kind, [&](auto field) { data = field(content); });
    return data;
}

bool isWhole(const pro_index& index) {
    return index.grid && index.bricks && index.cells && index.slabs && index.near_splats && index.listed &&
           index.blending;
}

std::uint64_t gridWords(const pro_index& index) {
    const std::uint64_t layer = std::uint64_t{index.size[0]} * index.size[1];
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return index.size[2] != 0 && layer > most / index.size[2] ? most : layer * index.size[2];
}

namespace {

/// Calls on(member, its offset in the header) for what a header says of a file.
template <typename Info, typename On>
void eachInfoField(Info& info, const On& on) {
    on(info.version_major, PRO_OFF_VERSION_MAJOR);
    on(info.version_minor, PRO_OFF_VERSION_MINOR);
    on(info.file_bytes, PRO_OFF_FILE_BYTES);
    on(info.flags, PRO_OFF_FLAGS);
    on(info.max_depth, PRO_OFF_MAX_DEPTH);
    on(info.splat_count, PRO_OFF_SPLAT_COUNT);
    on(info.node_count, PRO_OFF_NODE_COUNT);
    on(info.leaf_count, PRO_OFF_LEAF_COUNT);
    on(info.ref_count, PRO_OFF_REF_COUNT);
    on(info.material_count, PRO_OFF_MATERIAL_COUNT);
    on(info.radius_max, PRO_OFF_RADIUS_MAX);
    on(info.radius_step, PRO_OFF_RADIUS_STEP);
    on(info.blend_slab, PRO_OFF_BLEND_SLAB);
    on(info.scale, PRO_OFF_SCALE);
    on(info.origin, PRO_OFF_ORIGIN);
    on(info.bounds_min, PRO_OFF_BOUNDS_MIN);
    on(info.bounds_max, PRO_OFF_BOUNDS_MAX);
}

/// The same of the frame of the tracing index.
template <typename Index, typename On>
void eachFrameField(Index& index, const On& on) {
    on(index.shift, PRO_OFF_GRID_SHIFT);
    on(index.origin, PRO_OFF_GRID_ORIGIN);
    on(index.size, PRO_OFF_GRID_SIZE);
    on(index.uneven, PRO_OFF_GRID_UNEVEN);
    on(index.brick_count, PRO_OFF_BRICK_COUNT);
}

/// The same of the world.
template <typename World, typename On>
void eachWorldField(World& world, const On& on) {
    on(world.up, PRO_OFF_UP);
    on(world.metres_per_unit, PRO_OFF_METRES);
}

/// The same of the sampling.
template <typename Sampling, typename On>
void eachSamplingField(Sampling& sampling, const On& on) {
    on(sampling.input_count, PRO_OFF_INPUT_COUNT);
    on(sampling.filled_count, PRO_OFF_FILLED_COUNT);
    on(sampling.noise_median, PRO_OFF_NOISE);
}

/// The same of a section's record in the table.
template <typename Record, typename On>
void eachSectionField(Record& section, const On& on) {
    on(section.kind, PRO_SEC_OFF_KIND);
    on(section.stride, PRO_SEC_OFF_STRIDE);
    on(section.count, PRO_SEC_OFF_COUNT);
    on(section.offset, PRO_SEC_OFF_OFFSET);
    on(section.length, PRO_SEC_OFF_LENGTH);
    on(section.xxh3, PRO_SEC_OFF_XXH3);
    on(section.flags, PRO_SEC_OFF_FLAGS);
}

auto loadFrom(const std::byte* bytes) {
    return [bytes](auto& member, std::size_t offset) { std::memcpy(&member, bytes + offset, sizeof member); };
}

auto storeTo(std::byte* bytes) {
    return [bytes](const auto& member, std::size_t offset) { store(bytes, offset, member); };
}

std::size_t recordOffset(std::uint32_t index) { return PRO_TABLE_OFFSET + std::size_t{index} * PRO_SECTION_BYTES; }

} // namespace

pro_info loadInfo(const std::byte* header) {
    pro_info info{};
    eachInfoField(info, loadFrom(header));
    return info;
}

void storeInfo(std::byte* header, const pro_info& info) {
    storeU32(header, PRO_OFF_MAGIC, PRO_MAGIC_WORD0);
    storeU32(header, PRO_OFF_MAGIC + 4, PRO_MAGIC_WORD1);
    eachInfoField(info, storeTo(header));
}

pro_index loadFrame(const std::byte* header) {
    pro_index index{};
    eachFrameField(index, loadFrom(header));
    return index;
}

void storeFrame(std::byte* header, const pro_index& index) { eachFrameField(index, storeTo(header)); }

pro_world loadWorld(const std::byte* header) {
    pro_world world{};
    eachWorldField(world, loadFrom(header));
    return world;
}

void storeWorld(std::byte* header, const pro_world& world) { eachWorldField(world, storeTo(header)); }

pro_sampling loadSampling(const std::byte* header) {
    pro_sampling sampling{};
    eachSamplingField(sampling, loadFrom(header));
    return sampling;
}

void storeSampling(std::byte* header, const pro_sampling& sampling) { eachSamplingField(sampling, storeTo(header)); }

Section loadSection(const std::byte* header, std::uint32_t index) {
    Section section;
    eachSectionField(section, loadFrom(header + recordOffset(index)));
    return section;
}

void storeSection(std::byte* header, std::uint32_t index, const Section& section) {
    eachSectionField(section, storeTo(header + recordOffset(index)));
}

std::uint64_t checksum(const void* data, std::size_t bytes) { return XXH3_64bits(data, bytes); }

std::uint64_t headerChecksum(const std::byte* header) {
    return checksum(header + PRO_OFF_SECTION_COUNT, PRO_HEADER_BYTES - PRO_OFF_SECTION_COUNT);
}

} // namespace pointrt::format
