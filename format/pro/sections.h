// SPDX-License-Identifier: Apache-2.0
// The kinds of sections in a .pro file: one table of their strides, presence, data and counts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt::format {

/// The data of all sections. A null pointer is an absent section.
struct Content {
    pro_view view{};
    pro_index index{};         ///< its grid frame comes from the header
    pro_gaussians gaussians{}; ///< their coding comes from the header
    pro_world world{};
    pro_sampling sampling{};
    const std::byte* attribute_records = nullptr;   ///< ATTD
    std::size_t attribute_count = 0;                ///< records in ATTD
    std::vector<const std::byte*> attribute_values; ///< ATTR, in the order of the section table
};

constexpr std::uint32_t kBrickGroups = PRO_BRICK_WORDS / PRO_GROUP_WORDS;

/// kIndex, kGaussians: a file has all of these sections or none of them. kHarmonics: a file has it if and only if it
/// has Gaussians of a degree above 0. kExactGaussians: a file may have it if it has Gaussians.
enum class Presence { kMandatory, kOptional, kIndex, kGaussians, kHarmonics, kExactGaussians };

/// Reads and sets the pointer of a section in a Content.
struct DataAccess {
    const void* (*get)(const Content&);
    void (*set)(Content&, const void*);
};

/// Reads and sets the number of elements of a section.
struct CountAccess {
    std::uint64_t (*get)(const pro_info&, const Content&);
    void (*set)(Content&, std::uint64_t) = nullptr; ///< null if the header or another section gives the count
    std::uint64_t limit = 0; ///< largest count that set accepts; 0: the count must equal get() as soon as it is read
};

/// The format's rules for a kind. ATTR has none: a file may have many of them, of any stride.
struct SectionRule {
    std::uint32_t kind;
    std::uint32_t stride; ///< bytes per element; 0: the header decides (strideOf)
    Presence presence;
    bool traced; ///< PRO_OPEN_TRACE reads it from files with an index
    DataAccess data;
    CountAccess count;
};
extern const std::array<SectionRule, 22> kSectionRules; ///< in file order

/// Null for unknown kinds.
const SectionRule* findRule(std::uint32_t kind);

/// Bytes per element.
std::uint32_t strideOf(const SectionRule& rule, const Content& content);

/// Points content at the elements of a section, and sets their count if the header does not have it.
void setSection(Content& content, const SectionRule& rule, const void* data, std::uint64_t count);

/// The four characters of a kind for messages, with '?' for unprintable ones.
std::array<char, 5> kindName(std::uint32_t kind);

/// Whether all sections of the index are present.
bool isComplete(const pro_index& index);

/// Whether all sections that every file of Gaussians has are present.
bool isComplete(const pro_gaussians& gaussians);

/// Words in the entry grid by its frame, saturated at 2^64 - 1.
std::uint64_t gridWords(const pro_index& index);

} // namespace pointrt::format
