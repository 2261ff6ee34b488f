// SPDX-License-Identifier: Apache-2.0
// Measurements that are saved with a scene. They are not rendered but drawn over pictures.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/layer.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// A path, measured by its length, or a polygon, measured by its area.
struct MeasureDescription {
    std::vector<Vec3> points; ///< world frame; at least two, for a polygon three
    bool closed = false;      ///< true: a polygon
    bool visible = true;
    Layer layer{};
    bool operator==(const MeasureDescription&) const = default;
};

/// How the measurements of a scene are written.
struct MeasureUnits {
    std::string unit;      ///< of lengths, as unitName gives it; "" if unknown
    double scene_size = 1; ///< diagonal of the scans, above 0: decimals resolve a millionth of it
};

/// "12.345 m", the length of a path; "8.25 m2", the area of a polygon.
std::string measuredText(const MeasureDescription& measure, const MeasureUnits& units);
/// The same with the measurement's name, if it has one: "12.345 m, eaves".
std::string labelOf(const MeasureDescription& measure, const MeasureUnits& units);

/// The place of the measurement's label: half way along a path, or the mean of a polygon's corners.
Vec3 labelPlace(const MeasureDescription& measure);

} // namespace pointrt
