// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/section_files.h"

#include "runtime/measure/decimal_text.h"
#include "runtime/measure/dxf.h"
#include "runtime/measure/geojson.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// Calls draw(section, line) for each line; sections are numbered from 1.
template <typename Draw>
void forSectionLines(const SectionDrawing& drawing, const Draw& draw) {
    for (std::size_t k = 0; k < drawing.sections.size(); ++k)
        for (const SectionLine& line : drawing.sections[k].lines) draw(k + 1, line);
}

std::vector<Position> ringOf(const SectionLine& line) {
    std::vector<Position> points = line.points;
    if (line.closed) points.push_back(points.front());
    return points;
}

} // namespace

SectionDrawing flattened(SectionDrawing drawing) {
    for (DrawnSection& section : drawing.sections) {
        const SectionPlane plane = section.plane;
        for (SectionLine& line : section.lines)
            for (Position& point : line.points) {
                const Vec3 d = vectorOf(point) - vectorOf(plane.point);
                point = {dot(d, vectorOf(plane.right)), dot(d, vectorOf(plane.up)), 0};
            }
        section.plane = {};
    }
    drawing.epsg = 0;
    return drawing;
}

std::string sectionCsv(const SectionDrawing& drawing) {
    std::string text = "section,line,x,y,z\n";
    std::size_t number = 0;
    forSectionLines(drawing, [&](std::size_t section, const SectionLine& line) {
        const std::string start = std::to_string(section) + "," + std::to_string(++number);
        for (const Position& point : ringOf(line)) {
            text += start;
            for (const double value : point) text += "," + decimalText(value, drawing.decimals);
            text += "\n";
        }
    });
    return text;
}

std::string sectionDxf(const SectionDrawing& drawing) {
    std::vector<DxfEntity> entities;
    forSectionLines(drawing, [&](std::size_t section, const SectionLine& line) {
        entities.push_back({line.closed ? DxfEntity::Kind::kPolygon : DxfEntity::Kind::kPolyline,
                            "section_" + std::to_string(section), line.points});
    });
    return dxfText(entities, drawing.decimals);
}

std::string sectionGeoJson(const SectionDrawing& drawing) {
    std::vector<GeoFeature> features;
    forSectionLines(drawing, [&](std::size_t section, const SectionLine& line) {
        features.push_back({GeoKind::kLineString, ringOf(line), {{"section", static_cast<double>(section)}}});
    });
    return geoJsonText(features, drawing.decimals, drawing.epsg);
}

} // namespace pointrt
