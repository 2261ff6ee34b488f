// SPDX-License-Identifier: Apache-2.0
// The kinds of material of shaders/shared/materials.h as a C++ enumeration.
#pragma once

#include <array>
#include <cstdint>

#include "shaders/shared/materials.h"

namespace pointrt {

#define POINTRT_ENUMERATOR(number, NAME, Name, word, label, lobes, traits) k##Name = number,
enum class MaterialKind { MATERIALS(POINTRT_ENUMERATOR) };
#undef POINTRT_ENUMERATOR

struct MaterialKindRow {
    MaterialKind kind;
    const char* word;  ///< in scene files
    const char* label; ///< in the window
    std::uint32_t traits;
};

#define POINTRT_LISTED(number, NAME, Name, word, label, lobes, traits)                                                 \
    MaterialKindRow{MaterialKind::k##Name, word, label, traits},
constexpr std::array kMaterialKinds = {MATERIALS(POINTRT_LISTED)};
#undef POINTRT_LISTED

constexpr bool areNumberedInOrder(const decltype(kMaterialKinds)& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (static_cast<std::size_t>(rows[i].kind) != i) return false;
    return true;
}
static_assert(areNumberedInOrder(kMaterialKinds), "rows of MATERIALS must be numbered in order");
static_assert(kMaterialKinds.size() <= 8, "FEATURE_MATERIAL has eight bits (shaders/shared/params.h)");

constexpr const MaterialKindRow& rowOf(MaterialKind kind) { return kMaterialKinds.at(static_cast<std::size_t>(kind)); }

/// True if the kind has a trait MATERIAL_*.
constexpr bool hasTrait(MaterialKind kind, std::uint32_t trait) { return (rowOf(kind).traits & trait) != 0; }

} // namespace pointrt
