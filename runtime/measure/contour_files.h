// SPDX-License-Identifier: Apache-2.0
// Files of contour lines.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

struct ContourDrawing {
    std::vector<Contour> contours;          ///< as from surfaceContours
    Position east{1, 0, 0}, north{0, 1, 0}; ///< of the plan, unit length
    std::string unit;                       ///< of lengths, for labels; may be empty
    int decimals = 3;
    int epsg = 0; ///< of the coordinate system, 0 if unknown
};

/// 3D polylines in the scan's coordinates. Index contours, every fifth height, have their own layer.
std::string contourDxf(const ContourDrawing& drawing);
/// LineStrings with the property "height"; closed ones end where they start.
std::string contourGeoJson(const ContourDrawing& drawing);
/// A plan to scale with a scale bar, north up; every fifth line is thicker and labelled.
std::string contourSvg(const ContourDrawing& drawing);

} // namespace pointrt
