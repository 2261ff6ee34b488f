// SPDX-License-Identifier: Apache-2.0
// What a word for a colouring means in a scene: which numbers, which map, from where to where.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/device_scene/scene_paint.h"
#include "runtime/scene/legend.h"

namespace pointrt {

/// Words for what scans have without attributes: how high points lie, and where their surface looks.
inline constexpr const char* kHeight = "height";
inline constexpr const char* kNormal = "normal";

struct ColorChoice {
    std::vector<std::variant<std::monostate, NumberColors, NormalColors>> colors; ///< of each scan
    std::optional<Legend> legend;
};

/// For a request that is not for the scans' own colours; one range for all of them. Throws as planPaint does.
ColorChoice chooseColors(const std::vector<PlacedScan>& scans, const PaintRequest& request);

/// What color_by's word means in a scan; nothing where it has none, and for words that mean no number. up: unit vector.
std::optional<SplatNumbers> numbersFor(const PlacedScan& scan, const std::string& word, Vec3 up);

/// "NAMES have no "WORD", did you mean ...; there are ..." of attributes and the words besides.
std::string lackText(const std::vector<PlacedScan>& scans, const std::string& word,
                     const std::vector<std::string>& besides);

} // namespace pointrt
