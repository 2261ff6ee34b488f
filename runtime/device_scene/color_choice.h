// SPDX-License-Identifier: Apache-2.0
// What --color-by means in a scene: which numbers, which colour map, which range.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/device_scene/scene_paint.h"
#include "runtime/scene/legend.h"

namespace pointrt {

/// Names of numbers that every scan has even without attributes: heights and normals.
inline constexpr const char* kHeight = "height";
inline constexpr const char* kNormal = "normal";
/// The attribute that pointrt-rays compare adds: signed distances from another surface.
inline constexpr const char* kDistance = "distance";

struct ColorChoice {
    std::vector<std::variant<std::monostate, NumberColors, NormalColors>> colors; ///< for each scan
    std::optional<Legend> legend;
};

/// For any request but the scans' own colours. All scans share a range. Throws as planPaint does.
ColorChoice chooseColors(const std::vector<PlacedScan>& scans, const PaintRequest& request);

/// The numbers that word names in a scan; nullopt if there are none.
/// @param up unit vector
std::optional<SplatNumbers> numbersFor(const PlacedScan& scan, const std::string& word, Vec3 up);

/// Which splats of a scan the filters hide. Filters by attributes that the scan does not have hide nothing.
std::vector<SplatOverride::OfNumbers> selectionsOf(const PlacedScan& scan,
                                                   const std::vector<FilterDescription>& filters, Vec3 up);

/// "NAMES have no attribute "WORD", did you mean ...? Available: ...".
/// @param besides further names to list, before those of the attributes
std::string lackText(const std::vector<PlacedScan>& scans, const std::string& word,
                     const std::vector<std::string>& besides);

} // namespace pointrt
