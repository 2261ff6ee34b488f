// SPDX-License-Identifier: Apache-2.0
// GeoJSON (RFC 7946) in a scan's own coordinates.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

enum class GeoKind { kPoint, kLineString, kPolygon };

struct GeoFeature {
    GeoKind kind = GeoKind::kPoint;
    std::vector<Position> positions;                        ///< of a polygon: its corners, each once
    std::vector<std::pair<std::string, double>> properties; ///< finite numbers; names without " and backslashes
};

/// A FeatureCollection. Numbers have this many decimals.
/// @param epsg code of the coordinate system, 0 if unknown: written as the member "crs" of GeoJSON 2008, which GIS
///        programs read; RFC 7946 knows only longitude and latitude
std::string geoJsonText(const std::vector<GeoFeature>& features, int decimals, int epsg = 0);

} // namespace pointrt
