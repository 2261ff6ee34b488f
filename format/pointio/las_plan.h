// SPDX-License-Identifier: Apache-2.0
// What of points goes where in a LAS file.
#pragma once

#include <vector>

#include "format/pointio/las_fields.h"
#include "format/pointio/las_writer.h"
#include "format/pointio/point_columns.h"

namespace pointrt {

/// A field of the points, and the number of the outline's column that it takes its values from.
struct LasColumn {
    LasField field;
    std::size_t column = 0;
};

struct LasExport {
    LasDescription description;
    std::vector<LasColumn> columns;
    const LasField* colors = nullptr; ///< takes the column of colours, as no attribute has any
    std::size_t color_column = 0;
    const LasField* returns = nullptr; ///< no attribute numbers returns: the only one of each point
    std::vector<LasField> fields;      ///< of the point format
};

/// The version, point format, scale and records of the LAS file that the scan came from, as far as they can hold what
/// the points have; else the smallest point format that can, and a scale of a power of ten finer than their steps.
/// Attributes that are none of LAS become extra bytes; normals and radii are left out.
LasExport planLas(const PointOutline& outline, bool packed);

} // namespace pointrt
