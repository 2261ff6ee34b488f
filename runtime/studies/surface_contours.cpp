// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "format/base/parallel.h"
#include "runtime/measure/contour_lines.h"
#include "runtime/measure/decimal_text.h"
#include "runtime/measure/given_points.h"
#include "runtime/studies/cast_batch.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/studies/study_values.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

constexpr double kContourCellsAcross = 1000;
constexpr double kMostContourCells = 1 << 26;
constexpr double kMostLevels = 10000;
/// The default interval gives at most this many heights, and at least 10, as the next round number is at most 2.5 times
/// larger.
constexpr double kDefaultLevels = 25;
constexpr double kIndexed = 5; // every fifth line, as on topographic maps

/// The raster over a scene in a plan, from its lower left node.
struct PlanRaster {
    Vec3 corner; ///< lower left node, at the height where rays start
    double cell = 0;
    HeightRaster heights; ///< along up
};

void requireLength(double length, const char* what) {
    if (!(length >= 0 && std::isfinite(length)))
        refuseMeasure(std::string("the ") + what + " must be a finite length of 0 or more");
}

PlanRaster rasterOf(const TraceScene& scene, const PlanFrame& frame, double cell) {
    const auto [low, high] = planBounds(scene, frame);
    PlanRaster raster{{low.x, low.y, planHeights(scene, frame).high}, cell, {}};
    if (cell == 0) raster.cell = std::max(high.x - low.x, high.y - low.y) / kContourCellsAcross;
    const double columns = std::ceil((high.x - low.x) / raster.cell), rows = std::ceil((high.y - low.y) / raster.cell);
    if (!(columns * rows <= kMostContourCells))
        refuseMeasure("the cell is too small: the scene has more than 2^26 cells");
    raster.heights.columns = static_cast<std::size_t>(columns) + 1;
    raster.heights.rows = static_cast<std::size_t>(rows) + 1;
    return raster;
}

/// Casts a ray down through each node.
void measureHeights(const TraceScene& scene, const PlanFrame& frame, PlanRaster& raster) {
    HeightRaster& nodes = raster.heights;
    const double base = dot(frame.origin, frame.up);
    nodes.heights.reserve(nodes.columns * nodes.rows);
    CastBatch rays;
    const auto cast = [&] {
        for (const double distance : rays.cast(scene))
            nodes.heights.push_back(std::isfinite(distance) ? base + raster.corner.z - distance : std::nan(""));
        rays.clear();
    };
    for (std::size_t row = 0; row < nodes.rows; ++row)
        for (std::size_t column = 0; column < nodes.columns; ++column) {
            const Vec3 offset{static_cast<double>(column) * raster.cell, static_cast<double>(row) * raster.cell, 0};
            rays.add(frame.pointAt(raster.corner + offset), -1.0 * frame.up);
            if (rays.size() == kRaysAtOnce) cast();
        }
    cast();
}

/// The numbers of the levels, in intervals.
std::vector<double> levelsIn(const HeightRaster& raster, double& interval) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double height : raster.heights) {
        if (std::isnan(height)) continue;
        low = std::min(low, height);
        high = std::max(high, height);
    }
    if (!(low < high)) return {}; // no surface, or a level one
    if (interval == 0) interval = roundAbove((high - low) / kDefaultLevels);
    if ((high - low) / interval > kMostLevels) refuseMeasure("the interval is too small: more than 10000 heights");
    std::vector<double> levels;
    for (double level = std::ceil(low / interval); level * interval <= high; ++level) levels.push_back(level);
    return levels;
}

Contour placed(const ContourLine& line, const PlanRaster& raster, const PlanFrame& frame, double height) {
    Contour contour;
    contour.height = height;
    contour.closed = line.closed;
    const double z = height - dot(frame.origin, frame.up);
    for (const RasterPoint& point : line.points) {
        const Vec3 plan{raster.corner.x + point.column * raster.cell, raster.corner.y + point.row * raster.cell, z};
        contour.points.push_back(arrayOf(frame.pointAt(plan)));
    }
    return contour;
}

double lengthOf(const Contour& contour) {
    double sum = 0;
    for (std::size_t i = 1; i < contour.points.size(); ++i)
        sum += length(vectorOf(contour.points[i]) - vectorOf(contour.points[i - 1]));
    if (contour.closed) sum += length(vectorOf(contour.points.front()) - vectorOf(contour.points.back()));
    return sum;
}

} // namespace

std::vector<Contour> surfaceContours(const TraceScene& scene, const ContourRules& rules) {
    requireLength(rules.interval, "interval");
    requireLength(rules.cell, "cell");
    requireLength(rules.shortest, "shortest line");
    const SceneBounds bounds = scene.bounds();
    const PlanFrame frame = planFrame(0.5 * (vectorOf(bounds.low) + vectorOf(bounds.high)), rules.up);
    PlanRaster raster = rasterOf(scene, frame, rules.cell);
    measureHeights(scene, frame, raster);
    double interval = rules.interval;
    const std::vector<double> levels = levelsIn(raster.heights, interval);
    std::vector<std::vector<Contour>> of_level(levels.size());
    forAll(levels.size(), [&](std::size_t k) {
        for (const ContourLine& line : contourLines(raster.heights, levels[k] * interval)) {
            Contour contour = placed(line, raster, frame, levels[k] * interval);
            contour.is_index = std::fmod(levels[k], kIndexed) == 0;
            if (lengthOf(contour) >= rules.shortest) of_level[k].push_back(std::move(contour));
        }
    });
    std::vector<Contour> contours;
    for (std::vector<Contour>& level : of_level) std::move(level.begin(), level.end(), std::back_inserter(contours));
    return contours;
}

} // namespace pointrt
