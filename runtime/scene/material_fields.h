// SPDX-License-Identifier: Apache-2.0
// The fields of each kind of material: one list for reading and writing scene files and for the window's panel.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Largest number of materials in a scene.
constexpr std::size_t kMaxMaterials = 256;

struct MaterialField {
    const char* key; ///< in scene files
    std::variant<float MaterialDescription::*, bool MaterialDescription::*, Color MaterialDescription::*> member;
    double low, high; ///< range of numbers and colour components, inclusive
    // the rest is for the window
    const char* label;
    const char* tip;
    const char* format;                               ///< printf format of numbers
    bool logarithmic;                                 ///< numbers have a logarithmic slider
    bool MaterialDescription::*unless = nullptr;      ///< if true, the field has no effect: not shown, not written
    float MaterialDescription::*shown_with = nullptr; ///< shown only while this is above 0
};

/// The fields of a kind in the panel's order, without colour and emission, which all kinds have.
std::span<const MaterialField* const> fieldsOf(MaterialKind kind);
/// The fields of a kind in the order of written scene files.
std::vector<const MaterialField*> writtenFieldsOf(MaterialKind kind);

} // namespace pointrt
