// SPDX-License-Identifier: Apache-2.0
// The coordinate system that a LAS file names.
#pragma once

#include <string>
#include <string_view>

#include "format/pointio/las.h"

namespace pointrt {

struct LasCrs {
    enum class Kind { kUnknown, kProjected, kGeographic, kGeocentric };
    Kind kind = Kind::kUnknown;
    std::string name;           ///< WKT, or "EPSG:N"; "" where the file names none
    double metres_per_unit = 0; ///< of x and y; 0 where that is not known, or they are degrees
};

/// From a WKT record, or else from GeoTIFF keys. Keys that make no sense are left out.
LasCrs lasCrs(const LasFile& file);

/// Kind and unit of a coordinate system in WKT, version 1 or 2.
LasCrs crsOfWkt(std::string_view wkt);

} // namespace pointrt
