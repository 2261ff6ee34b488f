// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/rims.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "preprocess/cloud/median.h"
#include "preprocess/surface/grid_view.h"

namespace pointrt {
namespace {

/// Of a slope along the sight over across it: a laser's spot, or the window of a camera, is drawn out as much.
constexpr double kSteepest = 6;

/// A step as large as so many standard deviations of the scan is one of the surface.
constexpr double kNoisySteps = 6;

/// A scanner that is further away than so many diagonals of what it saw sees all of it in one direction, and steepness
/// tells the same everywhere.
constexpr double kFarDiagonals = 3;

/// The four neighbours of a cell.
constexpr std::array<GridStep, 4> kNeighbors = {GridStep{0, 1}, {0, -1}, {1, 0}, {-1, 0}};

/// What decides on the rims of one grid.
struct Rims {
    GridView view;
    bool has_sensor = false, is_near = false;
    Vec3d sensor = Vec3d::Zero(); ///< relative to the cloud's origin
    double noise = 0;             ///< standard deviation of the ranges

    /// Whether a depth camera told the point, which sees a surface or nothing: what lies in its projector's shadow is
    /// missing, and what is beside that is as good as all else.
    bool isStepped(std::uint32_t point) const { return !view.cloud.noise.empty() && view.cloud.noise[point] > 0; }
    double rangeOf(std::uint32_t point) const { return (view.position(point) - sensor).norm(); }
};

/// By second differences along the rows. Zero for a grid with hardly a sample.
double noiseOf(const Rims& rims) {
    std::vector<float> seconds;
    for (std::uint32_t row = 0; row < rims.view.grid.rows; ++row)
        for (std::uint32_t column = 0; column + 2 < rims.view.grid.columns; ++column) {
            const std::uint32_t a = rims.view.grid.at(row, column), b = rims.view.grid.at(row, column + 1),
                                c = rims.view.grid.at(row, column + 2);
            if (std::max({a, b, c}) >= RangeGrid::kLeftOut) continue;
            seconds.push_back(float(std::abs(rims.rangeOf(a) - 2 * rims.rangeOf(b) + rims.rangeOf(c))));
        }
    return deviationBySecondDifferences(std::move(seconds));
}

Rims rimsOf(const Cloud& cloud, const RangeGrid& grid) {
    Rims rims{{cloud, grid}};
    const auto& sensor = cloud.scans[grid.scan].sensor;
    if (!sensor) return rims;
    rims.has_sensor = true;
    rims.sensor = *sensor - cloud.origin;
    Eigen::AlignedBox3d box;
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kLeftOut) box.extend(rims.view.position(cell));
    rims.is_near = box.exteriorDistance(rims.sensor) < kFarDiagonals * box.diagonal().norm();
    rims.noise = noiseOf(rims);
    return rims;
}

bool isSteep(const Rims& rims, std::uint32_t a, std::uint32_t b) {
    const Vec3d between = rims.view.position(b) - rims.view.position(a);
    const Vec3d sight = ((rims.view.position(a) + rims.view.position(b)) / 2 - rims.sensor).normalized();
    const double along = std::abs(between.dot(sight));
    const double across_squared = std::max(0.0, between.squaredNorm() - along * along);
    const std::vector<float>& known = rims.view.cloud.noise;
    const double noise = known.empty() ? rims.noise : std::max({rims.noise, double(known[a]), double(known[b])});
    return along * along > kSteepest * kSteepest * across_squared && along > kNoisySteps * noise;
}

/// Whether the step from a cell to the next is one of three alike: 1 / range changes evenly over a plane, however
/// steeply it is seen. A sample that hit two surfaces, half of it each, makes two.
bool goesOn(const Rims& rims, GridCell from, GridStep step) {
    constexpr double kAlike = 1.5;
    std::array<double, 6> inverse; // of the cells 2 before to 3 after
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t cell = rims.view.at(from + (i - 2) * step);
        inverse[i] = cell < RangeGrid::kLeftOut ? 1 / rims.rangeOf(cell) : std::nan("");
    }
    for (int first = 0; first < 3; ++first) {
        double least = INFINITY, most = -INFINITY;
        bool known = true;
        for (int i = first; i < first + 3; ++i) {
            const double change = inverse[i + 1] - inverse[i];
            known = known && std::isfinite(change);
            least = std::min(least, change);
            most = std::max(most, change);
        }
        if (known && ((least > 0 && most <= kAlike * least) || (most < 0 && least >= kAlike * most))) return true;
    }
    return false;
}

bool isRim(const Rims& rims, GridCell cell, std::uint32_t point) {
    for (const GridStep step : kNeighbors) {
        const std::uint32_t beside = rims.view.at(cell + step);
        if (beside == RangeGrid::kNoPoint && !rims.isStepped(point)) return true;
        if (beside >= RangeGrid::kLeftOut || !rims.has_sensor || !isSteep(rims, point, beside)) continue;
        if (!rims.is_near || !goesOn(rims, cell, step)) return true;
    }
    return false;
}

/// Flags the rims of a grid; all or none.
void flagGrid(const Rims& rims, std::vector<std::uint8_t>& flags) {
    const RangeGrid& grid = rims.view.grid;
    tbb::parallel_for(std::uint32_t{0}, grid.rows, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column)
            if (const std::uint32_t point = grid.at(row, column); point < RangeGrid::kLeftOut)
                flags[point] = isRim(rims, {row, column}, point);
    });
    std::size_t points = 0, flagged = 0;
    for (const std::uint32_t cell : grid.point_of_cell) {
        if (cell >= RangeGrid::kLeftOut) continue;
        ++points;
        flagged += flags[cell];
    }
    if (2 * flagged <= points) return;
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kLeftOut) flags[cell] = 0;
}

} // namespace

std::vector<std::uint8_t> flagRims(const Cloud& cloud) {
    if (cloud.grids.empty()) return {};
    std::vector<std::uint8_t> flags(cloud.positions.size());
    for (const RangeGrid& grid : cloud.grids) flagGrid(rimsOf(cloud, grid), flags);
    const bool any = std::find(flags.begin(), flags.end(), 1) != flags.end();
    return any ? flags : std::vector<std::uint8_t>{};
}

} // namespace pointrt
