// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/geojson.h"

#include "runtime/measure/decimal_text.h"

namespace pointrt {
namespace {

std::string jsonPosition(const Position& point, int decimals) {
    return "[" + decimalText(point[0], decimals) + "," + decimalText(point[1], decimals) + "," +
           decimalText(point[2], decimals) + "]";
}

std::string coordinatesOf(const GeoFeature& feature, int decimals) {
    std::string text;
    for (const Position& point : feature.positions) text += (text.empty() ? "" : ",") + jsonPosition(point, decimals);
    if (feature.kind == GeoKind::kPoint) return text;
    if (feature.kind == GeoKind::kLineString) return "[" + text + "]";
    // rings are closed by their first point
    return "[[" + text + "," + jsonPosition(feature.positions.front(), decimals) + "]]";
}

std::string propertiesOf(const GeoFeature& feature, int decimals) {
    std::string text;
    for (const auto& [name, value] : feature.properties)
        text += (text.empty() ? "\"" : ",\"") + name + "\":" + decimalText(value, decimals);
    return text;
}

std::string jsonFeature(const GeoFeature& feature, int decimals) {
    constexpr const char* kNames[] = {"Point", "LineString", "Polygon"};
    return R"({"type":"Feature","properties":{)" + propertiesOf(feature, decimals) + R"(},"geometry":{"type":")" +
           kNames[static_cast<int>(feature.kind)] + R"(","coordinates":)" + coordinatesOf(feature, decimals) + "}}";
}

} // namespace

std::string geoJsonText(const std::vector<GeoFeature>& features, int decimals, int epsg) {
    std::string text;
    for (const GeoFeature& feature : features) text += (text.empty() ? "" : ",") + jsonFeature(feature, decimals);
    const std::string crs =
        R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::)" + std::to_string(epsg) + R"("}},)";
    return R"({"type":"FeatureCollection",)" + (epsg > 0 ? crs : "") + R"("features":[)" + text + "]}\n";
}

} // namespace pointrt
