// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/path_files.h"

#include "runtime/measure/decimal_text.h"
#include "runtime/measure/dxf.h"
#include "runtime/measure/geojson.h"
#include "runtime/util/vec_array.h"

namespace pointrt {

std::string pathCsv(const MeasuredPath& path) {
    std::string text = "point,x,y,z,length\n";
    double so_far = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        const Position& point = path.points[i];
        if (i > 0) so_far += length(vectorOf(point) - vectorOf(path.points[i - 1]));
        text += std::to_string(i + 1);
        for (const double value : {point[0], point[1], point[2], so_far})
            text += "," + decimalText(value, path.decimals);
        text += "\n";
    }
    return text;
}

std::string pathGeoJson(const MeasuredPath& path) {
    const PathMeasures& measures = path.measures;
    std::vector<GeoFeature> features{
        {GeoKind::kLineString,
         path.points,
         {{"length", measures.length}, {"height", measures.height}, {"horizontal", measures.horizontal}}}};
    if (measures.area)
        features.push_back(
            {GeoKind::kPolygon, path.points, {{"area", *measures.area}, {"plan_area", *measures.plan_area}}});
    return geoJsonText(features, path.decimals);
}

std::string pathDxf(const MeasuredPath& path) {
    return dxfText({{DxfEntity::Kind::kPolyline, "measurements", path.points}}, path.decimals);
}

} // namespace pointrt
