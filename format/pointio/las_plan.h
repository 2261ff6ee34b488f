// SPDX-License-Identifier: Apache-2.0
// The layout of points in a LAS file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "format/pointio/las_fields.h"
#include "format/pointio/las_writer.h"
#include "format/pointio/point_columns.h"

namespace pointrt {

/// A field of LAS points, and the index of the column whose values it takes.
struct LasColumn {
    LasField field;
    std::size_t column = 0;
};

/// If the LAS field with the attribute's name cannot hold its numbers, extra bytes hold them; the field gets them
/// scaled to its own range, for programs that read only LAS fields.
struct ScaledLasColumn {
    LasColumn column;
    std::array<double, 2> range{};
};

struct LasExport {
    LasDescription description;
    std::vector<LasColumn> columns;
    std::optional<ScaledLasColumn> intensity; ///< set if the LAS field cannot hold the numbers
    const LasField* colors = nullptr;         ///< takes color_column; null if an attribute holds colours
    std::size_t color_column = 0;
    const LasField* returns = nullptr; ///< set if no attribute has return numbers: each point is the only return
    std::vector<LasField> fields;      ///< all fields of the point format
};

/// Keeps version, point format, scale and records of the LAS file that the scan came from, if they can hold the points;
/// else uses the smallest point format that can, and the next power of ten below position_step as scale. Other
/// attributes become extra bytes. Omits normals and radii.
LasExport planLas(const PointOutline& outline, bool packed);

} // namespace pointrt
