// SPDX-License-Identifier: Apache-2.0
// The EPSG code of a coordinate system, without PROJ.
#pragma once

#include <string_view>

namespace pointrt {

/// The EPSG code that "EPSG:N" or WKT (version 1 or 2) states; for a compound system, that of its projected part. 0 if
/// no code is stated.
int epsgCode(std::string_view crs);

} // namespace pointrt
