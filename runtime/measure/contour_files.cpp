// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/contour_files.h"

#include "runtime/measure/dxf.h"
#include "runtime/measure/geojson.h"

namespace pointrt {

std::string contourDxf(const ContourDrawing& drawing) {
    std::vector<DxfEntity> entities;
    for (const Contour& each : drawing.contours)
        entities.push_back({each.closed ? DxfEntity::Kind::kPolygon : DxfEntity::Kind::kPolyline,
                            each.is_index ? "index_contours" : "contours", each.points});
    return dxfText(entities, drawing.decimals);
}

std::string contourGeoJson(const ContourDrawing& drawing) {
    std::vector<GeoFeature> features;
    for (const Contour& each : drawing.contours) {
        features.push_back({GeoKind::kLineString, each.points, {{"height", each.height}}});
        if (each.closed) features.back().positions.push_back(each.points.front());
    }
    return geoJsonText(features, drawing.decimals, drawing.epsg);
}

} // namespace pointrt
