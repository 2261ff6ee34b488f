// SPDX-License-Identifier: Apache-2.0
// Files of section lines.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// The lines in one plane.
struct DrawnSection {
    std::string name; ///< for labels: "z=1.2"; without characters that XML reserves
    SectionPlane plane;
    std::vector<SectionLine> lines; ///< as from sectionLines
};

struct SectionDrawing {
    std::vector<DrawnSection> sections;
    std::string unit; ///< of lengths, for labels; may be empty
    int decimals = 3;
    int epsg = 0; ///< of the coordinate system, 0 if unknown
};

/// The same lines in the coordinates of their drawings, x to the right, y up, z 0, relative to the plane's point.
/// Without a coordinate system.
SectionDrawing flattened(SectionDrawing drawing);

/// A row for each point: the numbers of section and line, from 1, x, y, z. Closed lines end where they start.
std::string sectionCsv(const SectionDrawing& drawing);
/// 3D polylines, each section in a layer of its own: section_1, section_2 ...
std::string sectionDxf(const SectionDrawing& drawing);
/// LineStrings with the property "section", from 1; closed ones end where they start.
std::string sectionGeoJson(const SectionDrawing& drawing);
/// The sections below each other, all to the same scale, with their names and a scale bar.
std::string sectionSvg(const SectionDrawing& drawing);

} // namespace pointrt
