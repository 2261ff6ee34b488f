// SPDX-License-Identifier: Apache-2.0
#include "format/pro/header.h"

#include <bit>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointrt::format {

// Sections are read in place, so their byte order cannot be swapped.
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

namespace {

/// Calls on(member, its offset in the header) for each field of a pro_info.
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

/// The same for the frame of the tracing index.
template <typename Index, typename On>
void eachFrameField(Index& index, const On& on) {
    on(index.shift, PRO_OFF_GRID_SHIFT);
    on(index.origin, PRO_OFF_GRID_ORIGIN);
    on(index.size, PRO_OFF_GRID_SIZE);
    on(index.uneven, PRO_OFF_GRID_UNEVEN);
    on(index.brick_count, PRO_OFF_BRICK_COUNT);
}

/// The same for the world.
template <typename World, typename On>
void eachWorldField(World& world, const On& on) {
    on(world.up, PRO_OFF_UP);
    on(world.metres_per_unit, PRO_OFF_METRES);
}

/// The same for the sampling.
template <typename Sampling, typename On>
void eachSamplingField(Sampling& sampling, const On& on) {
    on(sampling.input_count, PRO_OFF_INPUT_COUNT);
    on(sampling.filled_count, PRO_OFF_FILLED_COUNT);
    on(sampling.noise_median, PRO_OFF_NOISE);
}

/// The same for the coding of the Gaussians.
template <typename Gaussians, typename On>
void eachCodingField(Gaussians& gaussians, const On& on) {
    on(gaussians.degree, PRO_OFF_HARMONICS_DEGREE);
    on(gaussians.deviation_low, PRO_OFF_DEVIATION_LOW);
    on(gaussians.deviation_step, PRO_OFF_DEVIATION_STEP);
    on(gaussians.color_low, PRO_OFF_COLOR_LOW);
    on(gaussians.color_step, PRO_OFF_COLOR_STEP);
    on(gaussians.harmonic_max, PRO_OFF_HARMONIC_MAX);
}

/// The same for a record of the section table, with offsets within the record.
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

pro_gaussians loadGaussianCoding(const std::byte* header) {
    pro_gaussians gaussians{};
    eachCodingField(gaussians, loadFrom(header));
    return gaussians;
}

void storeGaussianCoding(std::byte* header, const pro_gaussians& gaussians) {
    eachCodingField(gaussians, storeTo(header));
}

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
