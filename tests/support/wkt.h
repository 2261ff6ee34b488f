// SPDX-License-Identifier: Apache-2.0
// Coordinate systems as WKT.
#pragma once

namespace pointrt::test {

inline constexpr const char* kUtm33 =
    R"wkt(PROJCRS["WGS 84 / UTM zone 33N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)wkt"
    R"wkt(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)wkt"
    R"wkt(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]]],CONVERSION["UTM zone 33N",)wkt"
    R"wkt(METHOD["Transverse Mercator",ID["EPSG",9807]],PARAMETER["Latitude of natural origin",0,)wkt"
    R"wkt(ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Longitude of natural origin",15,)wkt"
    R"wkt(ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Scale factor at natural origin",0.9996]],)wkt"
    R"wkt(CS[Cartesian,2],AXIS["(E)",east],AXIS["(N)",north],LENGTHUNIT["metre",1],ID["EPSG",32633]])wkt";

} // namespace pointrt::test
