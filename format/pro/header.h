// SPDX-License-Identifier: Apache-2.0
// The first 4096 bytes of a file, to structs and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt::format {

/// One record of the section table.
struct Section {
    std::uint32_t kind = 0, stride = 0;
    std::uint64_t count = 0, offset = 0, length = 0, xxh3 = 0;
    std::uint32_t flags = 0;
};

/// kIndex: all of these or none.
enum class Presence { kMandatory, kOptional, kIndex };

/// What the format says of a kind. ATTR has no rule: it may be there many times, of any stride.
struct KindRule {
    std::uint32_t kind;
    std::uint32_t stride;
    Presence presence;
    bool traced = true; ///< tracers with an index read it
};
inline constexpr std::array<KindRule, 17> kKindRules = {{
    {PRO_KIND_NODE, 4, Presence::kMandatory, false},
    {PRO_KIND_LEAF, 4 * PRO_LEAF_WORDS, Presence::kMandatory, false},
    {PRO_KIND_REFS, 4, Presence::kMandatory, false},
    {PRO_KIND_SPLT, 4 * PRO_SPLAT_WORDS, Presence::kMandatory},
    {PRO_KIND_MATL, 4 * PRO_MATERIAL_FLOATS, Presence::kMandatory},
    {PRO_KIND_ORDR, 4, Presence::kOptional, false},
    {PRO_KIND_META, 1, Presence::kOptional, false},
    {PRO_KIND_ENTR, 4, Presence::kIndex},
    {PRO_KIND_BRKS, 4 * PRO_GROUP_WORDS, Presence::kIndex},
    {PRO_KIND_CELS, 4 * PRO_CELL_WORDS, Presence::kIndex},
    {PRO_KIND_SLBS, 4, Presence::kIndex},
    {PRO_KIND_DSCS, 2 * 4 * PRO_NEAR_WORDS, Presence::kIndex},
    {PRO_KIND_DSPL, 2 * 4, Presence::kIndex},
    {PRO_KIND_BLDS, 2 * 2, Presence::kIndex},
    {PRO_KIND_NOIS, 1, Presence::kOptional},
    {PRO_KIND_SENS, 8 * PRO_SENSOR_DOUBLES, Presence::kOptional},
    {PRO_KIND_ATTD, PRO_ATTRIBUTE_BYTES, Presence::kOptional},
}};

/// What sections hold, whichever they are; null pointers are sections that are not there.
struct Content {
    pro_view view{};
    pro_index index{}; ///< its frame comes from the header
    pro_world world{};
    pro_sampling sampling{};
    const std::byte* attribute_records = nullptr;   ///< ATTD
    std::size_t attribute_count = 0;                ///< records
    std::vector<const std::byte*> attribute_values; ///< ATTR, in the order of the table
};

/// Null for kinds that the format does not know.
const KindRule* findRule(std::uint32_t kind);

/// The kind's four characters for messages, with '?' for what cannot be printed.
std::array<char, 5> kindName(std::uint32_t kind);

/// Elements of a kind, as the header and the content's own counts have it.
std::uint64_t elementCount(std::uint32_t kind, const pro_info& info, const Content& content);

/// Points the content's field for kind at data, and sets the count where it is one of the content's own.
void setSection(Content& content, std::uint32_t kind, const std::byte* data, std::uint64_t count);
const void* sectionData(const Content& content, std::uint32_t kind);

/// Whether all pointers of the index are set.
bool isWhole(const pro_index& index);

/// Words of the grid as the frame has them, 2^64 - 1 at most.
std::uint64_t gridWords(const pro_index& index);

/// Header bytes (PRO_HEADER_BYTES of them) to structs and back. Nothing is checked.
pro_info loadInfo(const std::byte* header);
void storeInfo(std::byte* header, const pro_info& info);
/// The index's frame: all but counts of sections and pointers.
pro_index loadFrame(const std::byte* header);
void storeFrame(std::byte* header, const pro_index& index);
/// What the header has of the world; sensors are null.
pro_world loadWorld(const std::byte* header);
void storeWorld(std::byte* header, const pro_world& world);
/// What the header has of the sampling; noise is null.
pro_sampling loadSampling(const std::byte* header);
void storeSampling(std::byte* header, const pro_sampling& sampling);
Section loadSection(const std::byte* header, std::uint32_t index);
void storeSection(std::byte* header, std::uint32_t index, const Section& section);
std::uint32_t loadU32(const std::byte* bytes, std::size_t offset);
void storeU32(std::byte* bytes, std::size_t offset, std::uint32_t value);
std::uint64_t loadU64(const std::byte* bytes, std::size_t offset);
void storeU64(std::byte* bytes, std::size_t offset, std::uint64_t value);

/// XXH3-64 of bytes, and of the part of a header that PRO_OFF_HEADER_XXH3 covers.
std::uint64_t checksum(const void* data, std::size_t bytes);
std::uint64_t headerChecksum(const std::byte* header);

} // namespace pointrt::format
