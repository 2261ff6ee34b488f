// SPDX-License-Identifier: Apache-2.0
// The EPSG code of a coordinate system, without PROJ.
#pragma once

#include <string_view>

namespace pointrt {

/// Of "EPSG:N" or of WKT that states it, version 1 or 2; the projected part of a compound system. 0 if there is none.
int epsgCode(std::string_view crs);

} // namespace pointrt
