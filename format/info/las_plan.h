// SPDX-License-Identifier: Apache-2.0
// What of a .pro goes where in a LAS file.
#pragma once

#include <vector>

#include "format/info/export_source.h"
#include "format/scanfile/las_fields.h"
#include "format/scanfile/las_writer.h"

namespace pointrt {

/// A field of the points, and the number of the attribute that it takes its values from.
struct LasColumn {
    LasField field;
    std::size_t attribute = 0;
};

struct LasExport {
    LasDescription description;
    std::vector<LasColumn> columns;
    const LasField* colors = nullptr;  ///< takes the colours of the splats, as no attribute has any
    const LasField* returns = nullptr; ///< no attribute numbers returns: the only one of each point
    std::vector<LasField> fields;      ///< of the point format
};

/// The version, point format, scale and records of the LAS file that the scan came from, as far as they can hold what
/// the scan has; else the smallest point format that can, and a scale of a power of ten finer than the scan's steps.
/// Attributes that are none of LAS become extra bytes.
LasExport planLas(const ExportSource& source, bool packed);

} // namespace pointrt
