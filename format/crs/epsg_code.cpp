// SPDX-License-Identifier: Apache-2.0
#include "format/crs/epsg_code.h"

#include <charconv>
#include <string>

#include "format/crs/wkt.h"

namespace pointrt {
namespace {

int numberIn(std::string_view text) {
    int code = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), code);
    constexpr int kMost = 32766; // EPSG's codes; 32767 means user-defined in GeoTIFF
    return failure == std::errc() && end == text.data() + text.size() && code > 0 && code <= kMost ? code : 0;
}

/// The code in "EPSG","2056" or "EPSG",2056, the content of AUTHORITY or ID.
int codeOf(std::string_view authority) {
    const std::size_t comma = authority.find(',');
    if (comma == authority.npos || !authority.starts_with("\"EPSG\"")) return 0;
    std::string digits;
    for (const char letter : authority.substr(comma + 1))
        if (letter != '"' && letter != ' ') digits += letter;
    return numberIn(digits);
}

} // namespace

int epsgCode(std::string_view crs) {
    if (crs.starts_with("EPSG:")) return numberIn(crs.substr(5));
    if (const auto compound = wktChild(crs, {"COMPD_CS", "COMPOUNDCRS"})) crs = *compound;
    if (const auto projected = wktChild(crs, {"PROJCS", "PROJCRS", "PROJECTEDCRS"})) crs = *projected;
    const auto authority = wktChild(crs, {"AUTHORITY", "ID"});
    return authority ? codeOf(*authority) : 0;
}

} // namespace pointrt
