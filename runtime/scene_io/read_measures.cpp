// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/read_parts.h"

namespace pointrt {
namespace {

MeasureDescription measureOf(const SceneValue& table) {
    requireKnownKeys(table, "a measurement", {"points", "closed", "visible", "name", "locked"});
    MeasureDescription measure;
    takeFlag(table, "closed", measure.closed);
    takeFlag(table, "visible", measure.visible);
    takeLayer(table, measure.layer);
    const SceneValue points = require(table, "points");
    for (const SceneValue& point : elementsOf(points)) measure.points.push_back(vectorOf(point));
    if (measure.points.size() < (measure.closed ? 3u : 2u))
        refuse(points, measure.closed ? "a closed measurement needs at least three points"
                                      : "a measurement needs at least two points");
    return measure;
}

} // namespace

void readMeasures(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "measure")) reading.scene.measures.push_back(measureOf(table));
}

} // namespace pointrt
