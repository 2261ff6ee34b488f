// SPDX-License-Identifier: Apache-2.0
// The coordinate system in the metadata of a .pro.
#pragma once

#include <string>
#include <string_view>

namespace pointrt {

/// "EPSG:N" or WKT from the META section of a .pro; "" if it names none.
std::string crsOfMetadata(std::string_view metadata);

} // namespace pointrt
