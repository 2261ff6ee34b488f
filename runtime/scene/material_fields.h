// SPDX-License-Identifier: Apache-2.0
// What kinds of material have: one list for reading and writing scene files and for the window's panel.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The most materials that a scene holds.
constexpr std::size_t kMaxMaterials = 256;

struct MaterialField {
    const char* key; ///< in scene files
    std::variant<float MaterialDescription::*, bool MaterialDescription::*, Color MaterialDescription::*> member;
    double low, high; ///< of numbers and colours, ends included
    // in the window
    const char* label;
    const char* tip;
    const char* format;                          ///< of numbers
    bool logarithmic;                            ///< numbers are
    bool MaterialDescription::*unless = nullptr; ///< where this holds, it says nothing: it is neither shown nor written
    float MaterialDescription::*shown_with = nullptr; ///< it is shown where that is above 0
};

/// Those of a kind beside colour and emission, which all have, in the panel's order.
std::span<const MaterialField* const> fieldsOf(MaterialKind kind);
/// Those of a kind in the order in which scene files are written.
std::vector<const MaterialField*> writtenFieldsOf(MaterialKind kind);

} // namespace pointrt
