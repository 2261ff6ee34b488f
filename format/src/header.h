// SPDX-License-Identifier: Apache-2.0
// The first 4096 bytes of a file, to structs and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pointrt/pro.h"

namespace pointrt::format {

/// One record of the section table.
struct Section {
    std::uint32_t kind = 0, stride = 0;
    std::uint64_t count = 0, offset = 0, length = 0, xxh3 = 0;
    std::uint32_t flags = 0;
};

/// What version 1.0 says of a kind.
struct KindRule {
    std::uint32_t kind;
    std::uint32_t stride;
    bool mandatory;
};
inline constexpr std::array<KindRule, 7> kKindRules = {{
    {PRO_KIND_NODE, 4, true},
    {PRO_KIND_LEAF, 4 * PRO_LEAF_WORDS, true},
    {PRO_KIND_REFS, 4, true},
    {PRO_KIND_SPLT, 4 * PRO_SPLAT_WORDS, true},
    {PRO_KIND_MATL, 4 * PRO_MATERIAL_FLOATS, true},
    {PRO_KIND_ORDR, 4, false},
    {PRO_KIND_META, 1, false},
}};

/// Null for kinds that version 1.0 does not know.
const KindRule* findRule(std::uint32_t kind);

/// The kind's four characters for messages, with '?' for what cannot be printed.
std::array<char, 5> kindName(std::uint32_t kind);

/// Elements that the header promises for a kind; view.metadata_bytes for META.
std::uint64_t promisedCount(std::uint32_t kind, const pro_info& info, const pro_view& view);

/// Points view's field for kind at data; count is used for META.
void setSection(pro_view& view, std::uint32_t kind, const std::byte* data, std::uint64_t count);
const void* sectionData(const pro_view& view, std::uint32_t kind);

/// Header bytes (PRO_HEADER_BYTES of them) to structs and back. Nothing is checked.
pro_info loadInfo(const std::byte* header);
void storeInfo(std::byte* header, const pro_info& info);
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
