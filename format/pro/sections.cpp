// SPDX-License-Identifier: Apache-2.0
#include "format/pro/sections.h"

#include <limits>
#include <type_traits>

namespace pointrt::format {

namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kPair = 2; ///< near splats per element of DSCS and DSPL, and numbers per element of BLDS

/// The pointer content.*Part.*Field.
template <auto Part, auto Field>
constexpr DataAccess kPointer{[](const Content& content) -> const void* { return content.*Part.*Field; },
                              [](Content& content, const void* data) {
                                  auto& pointer = content.*Part.*Field;
                                  pointer = static_cast<std::remove_reference_t<decltype(pointer)>>(data);
                              }};

constexpr DataAccess kAttributeRecords{
    [](const Content& content) -> const void* { return content.attribute_records; },
    [](Content& content, const void* data) { content.attribute_records = static_cast<const std::byte*>(data); }};

/// A count in the header.
template <auto Field>
constexpr CountAccess kInfoCount{[](const pro_info& info, const Content&) -> std::uint64_t { return info.*Field; }};

/// A count of the index that this section determines, with this many to an element.
template <auto Field, std::uint32_t kEach = 1>
constexpr CountAccess kIndexCount{
    [](const pro_info&, const Content& content) -> std::uint64_t { return content.index.*Field / kEach; },
    [](Content& content, std::uint64_t count) { content.index.*Field = static_cast<std::uint32_t>(count) * kEach; },
    PRO_INDEX_LISTED_MAX / kEach};

/// A count of the index that another section determines, perhaps a later one, so it is compared when all are set.
template <auto Field, std::uint32_t kEach = 1>
constexpr CountAccess kIndexCountElsewhere{kIndexCount<Field, kEach>.get, nullptr, kIndexCount<Field, kEach>.limit};

constexpr CountAccess kBrickWords{
    [](const pro_info&, const Content& content) {
        return std::uint64_t{content.index.brick_count} * kBrickGroups + content.index.group_count;
    },
    [](Content& content, std::uint64_t count) {
        content.index.group_count = static_cast<std::uint32_t>(count) - content.index.brick_count * kBrickGroups;
    },
    PRO_INDEX_LISTED_MAX};

constexpr CountAccess kGridWords{[](const pro_info&, const Content& content) { return gridWords(content.index); }};

/// A count of the Gaussians that this section determines.
template <auto Field>
constexpr CountAccess kGaussianCount{
    [](const pro_info&, const Content& content) -> std::uint64_t { return content.gaussians.*Field; },
    [](Content& content, std::uint64_t count) { content.gaussians.*Field = static_cast<std::uint32_t>(count); },
    PRO_GAUSSIAN_LISTED_MAX};

constexpr CountAccess kMetadataBytes{
    [](const pro_info&, const Content& content) -> std::uint64_t { return content.view.metadata_bytes; },
    [](Content& content, std::uint64_t count) { content.view.metadata_bytes = count; }, kUnlimited};

constexpr CountAccess kSensorCount{
    [](const pro_info&, const Content& content) -> std::uint64_t { return content.world.sensor_count; },
    [](Content& content, std::uint64_t count) { content.world.sensor_count = static_cast<std::uint32_t>(count); },
    PRO_INDEX_LISTED_MAX};

constexpr CountAccess kAttributeCount{
    [](const pro_info&, const Content& content) -> std::uint64_t { return content.attribute_count; },
    [](Content& content, std::uint64_t count) { content.attribute_count = count; }, PRO_ATTRIBUTE_MAX};

constexpr auto kMandatory = Presence::kMandatory, kOptional = Presence::kOptional, kIndex = Presence::kIndex;
constexpr auto kViewPart = &Content::view;
constexpr auto kIndexPart = &Content::index;
constexpr auto kGaussianPart = &Content::gaussians;
constexpr auto kGaussians = Presence::kGaussians, kHarmonics = Presence::kHarmonics;
constexpr CountAccess kSplatCount = kInfoCount<&pro_info::splat_count>;
static_assert(sizeof(pro_exact_gaussian) == PRO_EXACT_GAUSSIAN_BYTES); // GEXA is read in place

} // namespace

constexpr std::array<SectionRule, 22> kSectionRules = {{
    {PRO_KIND_NODE, 4, kMandatory, false, kPointer<kViewPart, &pro_view::nodes>, kInfoCount<&pro_info::node_count>},
    {PRO_KIND_LEAF, 4 * PRO_LEAF_WORDS, kMandatory, false, kPointer<kViewPart, &pro_view::leaves>,
     kInfoCount<&pro_info::leaf_count>},
    {PRO_KIND_REFS, 4, kMandatory, false, kPointer<kViewPart, &pro_view::refs>, kInfoCount<&pro_info::ref_count>},
    {PRO_KIND_SPLT, 4 * PRO_SPLAT_WORDS, kMandatory, true, kPointer<kViewPart, &pro_view::splats>, kSplatCount},
    {PRO_KIND_MATL, 4 * PRO_MATERIAL_FLOATS, kMandatory, true, kPointer<kViewPart, &pro_view::materials>,
     kInfoCount<&pro_info::material_count>},
    {PRO_KIND_ORDR, 4, kOptional, false, kPointer<kViewPart, &pro_view::order>, kSplatCount},
    {PRO_KIND_META, 1, kOptional, false, kPointer<kViewPart, &pro_view::metadata>, kMetadataBytes},
    {PRO_KIND_ENTR, 4, kIndex, true, kPointer<kIndexPart, &pro_index::grid>, kGridWords},
    {PRO_KIND_BRKS, 4 * PRO_GROUP_WORDS, kIndex, true, kPointer<kIndexPart, &pro_index::bricks>, kBrickWords},
    {PRO_KIND_CELS, 4 * PRO_CELL_WORDS, kIndex, true, kPointer<kIndexPart, &pro_index::cells>,
     kIndexCount<&pro_index::cell_count>},
    {PRO_KIND_SLBS, 4, kIndex, true, kPointer<kIndexPart, &pro_index::slabs>,
     kIndexCountElsewhere<&pro_index::cell_count>},
    {PRO_KIND_DSCS, kPair * 4 * PRO_NEAR_WORDS, kIndex, true, kPointer<kIndexPart, &pro_index::near_splats>,
     kIndexCount<&pro_index::near_count, kPair>},
    {PRO_KIND_DSPL, kPair * 4, kIndex, true, kPointer<kIndexPart, &pro_index::listed>,
     kIndexCountElsewhere<&pro_index::near_count, kPair>},
    {PRO_KIND_BLDS, kPair * 2, kIndex, true, kPointer<kIndexPart, &pro_index::blending>,
     kIndexCount<&pro_index::blending_count, kPair>},
    {PRO_KIND_GAUS, 4 * PRO_GAUSSIAN_WORDS, kGaussians, true, kPointer<kGaussianPart, &pro_gaussians::words>,
     kSplatCount},
    {PRO_KIND_GHRM, 0, kHarmonics, true, kPointer<kGaussianPart, &pro_gaussians::harmonics>, kSplatCount},
    {PRO_KIND_GNOD, 4 * PRO_GAUSSIAN_NODE_WORDS, kGaussians, true, kPointer<kGaussianPart, &pro_gaussians::nodes>,
     kGaussianCount<&pro_gaussians::node_count>},
    {PRO_KIND_GLST, 4, kGaussians, true, kPointer<kGaussianPart, &pro_gaussians::lists>,
     kGaussianCount<&pro_gaussians::list_count>},
    {PRO_KIND_GEXA, PRO_EXACT_GAUSSIAN_BYTES, Presence::kExactGaussians, true,
     kPointer<kGaussianPart, &pro_gaussians::exact>, kGaussianCount<&pro_gaussians::exact_count>},
    {PRO_KIND_NOIS, 1, kOptional, true, kPointer<&Content::sampling, &pro_sampling::noise>, kSplatCount},
    {PRO_KIND_SENS, 8 * PRO_SENSOR_DOUBLES, kOptional, true, kPointer<&Content::world, &pro_world::sensors>,
     kSensorCount},
    {PRO_KIND_ATTD, PRO_ATTRIBUTE_BYTES, kOptional, true, kAttributeRecords, kAttributeCount},
}};

const SectionRule* findRule(std::uint32_t kind) {
    for (const SectionRule& rule : kSectionRules)
        if (rule.kind == kind) return &rule;
    return nullptr;
}

std::uint32_t strideOf(const SectionRule& rule, const Content& content) {
    return rule.presence == kHarmonics ? 3 * pro_harmonic_count(content.gaussians.degree) : rule.stride;
}

void setSection(Content& content, const SectionRule& rule, const void* data, std::uint64_t count) {
    rule.data.set(content, data);
    if (rule.count.set) rule.count.set(content, count);
}

std::array<char, 5> kindName(std::uint32_t kind) {
    std::array<char, 5> name{};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto c = static_cast<char>(kind >> (8 * i) & 0xFF);
        name[i] = c > ' ' && c <= '~' ? c : '?';
    }
    return name;
}

bool isComplete(const pro_index& index) {
    return index.grid && index.bricks && index.cells && index.slabs && index.near_splats && index.listed &&
           index.blending;
}

bool isComplete(const pro_gaussians& gaussians) { return gaussians.words && gaussians.nodes && gaussians.lists; }

std::uint64_t gridWords(const pro_index& index) {
    const std::uint64_t layer = std::uint64_t{index.size[0]} * index.size[1];
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return index.size[2] != 0 && layer > most / index.size[2] ? most : layer * index.size[2];
}

} // namespace pointrt::format
