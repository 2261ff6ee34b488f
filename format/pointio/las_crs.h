// SPDX-License-Identifier: Apache-2.0
// The coordinate system of a LAS file.
#pragma once

#include <string>
#include <string_view>

#include "format/pointio/las.h"

namespace pointrt {

struct LasCrs {
    enum class Kind { kUnknown, kProjected, kGeographic, kGeocentric };
    Kind kind = Kind::kUnknown;
    std::string name;           ///< WKT, or "EPSG:N"; "" if the file names none
    double metres_per_unit = 0; ///< of x and y; 0 if unknown or in degrees
};

/// Reads a WKT record, else GeoTIFF keys; ignores invalid keys. Keys without a unit take that of the EPSG code, if PROJ
/// is installed.
LasCrs lasCrs(const LasFile& file);

/// Reads GeoTIFF keys, the same in LAS and in TIFF files: GeoKeyDirectoryTag and GeoDoubleParamsTag, little-endian.
LasCrs crsOfGeoKeys(std::string_view directory, std::string_view doubles);

/// Kind and unit of a coordinate system in WKT, version 1 or 2.
LasCrs crsOfWkt(std::string_view wkt);

} // namespace pointrt
