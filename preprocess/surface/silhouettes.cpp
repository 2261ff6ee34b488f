// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/silhouettes.h"

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

/// Largest slope, along the line of sight over across it: a laser's spot, or a camera's window, is elongated by as
/// much.
constexpr double kSteepest = 6;

/// Least step of the surface, in standard deviations of the scan.
constexpr double kNoisySteps = 6;

/// A scanner further away than this many diagonals of its points sees them all in nearly the same direction, where a
/// slope means the same everywhere.
constexpr double kFarDiagonals = 3;

/// Steps to the four adjacent cells.
constexpr std::array<GridStep, 4> kNeighbors = {GridStep{0, 1}, {0, -1}, {1, 0}, {-1, 0}};

/// A grid with properties measured on its scan.
struct ScanGrid {
    GridView view;
    bool has_sensor = false, is_near = false;
    Vec3d sensor = Vec3d::Zero(); ///< relative to the cloud's origin
    double noise = 0;             ///< standard deviation of the ranges

    /// Whether a depth camera measured the point. It has no mixed pixels: points in its projector's shadow are missing,
    /// and those beside it are as good as others.
    bool isFromDepthCamera(std::uint32_t point) const {
        return !view.cloud.noise.empty() && view.cloud.noise[point] > 0;
    }
    double rangeOf(std::uint32_t point) const { return (view.position(point) - sensor).norm(); }
};

/// Noise of the ranges, from second differences along the rows. Zero for a grid with hardly a sample.
double noiseOf(const ScanGrid& scan) {
    std::vector<float> seconds;
    for (std::uint32_t row = 0; row < scan.view.grid.rows; ++row)
        for (std::uint32_t column = 0; column + 2 < scan.view.grid.columns; ++column) {
            const std::uint32_t a = scan.view.grid.at(row, column), b = scan.view.grid.at(row, column + 1),
                                c = scan.view.grid.at(row, column + 2);
            if (std::max({a, b, c}) >= RangeGrid::kFilteredOut) continue;
            seconds.push_back(float(std::abs(scan.rangeOf(a) - 2 * scan.rangeOf(b) + scan.rangeOf(c))));
        }
    return deviationBySecondDifferences(std::move(seconds));
}

ScanGrid scanGridOf(const Cloud& cloud, const RangeGrid& grid) {
    ScanGrid scan{{cloud, grid}};
    const auto& sensor = cloud.scans[grid.scan].sensor;
    if (!sensor) return scan;
    scan.has_sensor = true;
    scan.sensor = *sensor - cloud.origin;
    Eigen::AlignedBox3d box;
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kFilteredOut) box.extend(scan.view.position(cell));
    scan.is_near = box.exteriorDistance(scan.sensor) < kFarDiagonals * box.diagonal().norm();
    scan.noise = noiseOf(scan);
    return scan;
}

bool isSteep(const ScanGrid& scan, std::uint32_t a, std::uint32_t b) {
    const Vec3d between = scan.view.position(b) - scan.view.position(a);
    const Vec3d view_direction = ((scan.view.position(a) + scan.view.position(b)) / 2 - scan.sensor).normalized();
    const double along = std::abs(between.dot(view_direction));
    const double across_squared = std::max(0.0, between.squaredNorm() - along * along);
    const std::vector<float>& known = scan.view.cloud.noise;
    const double noise = known.empty() ? scan.noise : std::max({scan.noise, double(known[a]), double(known[b])});
    return along * along > kSteepest * kSteepest * across_squared && along > kNoisySteps * noise;
}

/// Whether the step from a cell to the next is one of three similar ones: 1 / range changes evenly over a plane,
/// however steep. A mixed pixel, between two surfaces, makes only two.
bool continues(const ScanGrid& scan, GridCell from, GridStep step) {
    constexpr double kAlike = 1.5;
    std::array<double, 6> inverse; // of the cells 2 before to 3 after
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t cell = scan.view.at(from + (i - 2) * step);
        inverse[i] = cell < RangeGrid::kFilteredOut ? 1 / scan.rangeOf(cell) : std::nan("");
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

/// Whether a sample is a mixed pixel of a station: between a surface in front of it, on one side, and one behind it, on
/// the opposite side, and no surface leads from one to the other.
bool isMixedPixel(const ScanGrid& scan, GridCell cell, std::uint32_t point) {
    for (const GridStep step : {GridStep{0, 1}, GridStep{1, 0}}) {
        const GridStep back{-step.rows, -step.columns};
        const std::uint32_t before = scan.view.at(cell + back), after = scan.view.at(cell + step);
        if (std::max(before, after) >= RangeGrid::kFilteredOut) continue;
        const double range = scan.rangeOf(point);
        if ((scan.rangeOf(before) < range) == (scan.rangeOf(after) < range)) continue;
        if (isSteep(scan, point, before) && isSteep(scan, point, after) && !continues(scan, cell, step) &&
            !continues(scan, cell, back))
            return true;
    }
    return false;
}

/// A station measures thin objects and rims correctly, so only its mixed pixels count. Samples of a distant scanner
/// that triangulates curl around edges.
bool isSilhouette(const ScanGrid& scan, GridCell cell, std::uint32_t point) {
    if (scan.has_sensor && scan.is_near) return isMixedPixel(scan, cell, point);
    for (const GridStep step : kNeighbors) {
        const std::uint32_t beside = scan.view.at(cell + step);
        if (beside == RangeGrid::kNoPoint && !scan.isFromDepthCamera(point)) return true;
        if (beside >= RangeGrid::kFilteredOut || !scan.has_sensor || !isSteep(scan, point, beside)) continue;
        return true;
    }
    return false;
}

/// Flags the silhouettes of a grid, or none if more than half of it would be flagged.
void flagGrid(const ScanGrid& scan, std::vector<std::uint8_t>& flags) {
    const RangeGrid& grid = scan.view.grid;
    tbb::parallel_for(std::uint32_t{0}, grid.rows, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column)
            if (const std::uint32_t point = grid.at(row, column); point < RangeGrid::kFilteredOut)
                flags[point] = isSilhouette(scan, {row, column}, point);
    });
    std::size_t points = 0, flagged = 0;
    for (const std::uint32_t cell : grid.point_of_cell) {
        if (cell >= RangeGrid::kFilteredOut) continue;
        ++points;
        flagged += flags[cell];
    }
    if (2 * flagged <= points) return;
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kFilteredOut) flags[cell] = 0;
}

} // namespace

std::vector<std::uint8_t> flagSilhouettes(const Cloud& cloud) {
    if (cloud.grids.empty()) return {};
    std::vector<std::uint8_t> flags(cloud.positions.size());
    for (const RangeGrid& grid : cloud.grids) flagGrid(scanGridOf(cloud, grid), flags);
    const bool any = std::find(flags.begin(), flags.end(), 1) != flags.end();
    return any ? flags : std::vector<std::uint8_t>{};
}

} // namespace pointrt
