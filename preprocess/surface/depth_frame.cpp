// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/depth_frame.h"

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/median.h"

namespace pointrt {
namespace {

/// Depths closer than this, relative to the largest, are equal: positions are rounded floats, possibly rotated.
constexpr double kSameDepth = 2e-6;

/// Distinct values, ascending; merges values closer than tolerance.
std::vector<double> distinct(std::vector<double> values, double tolerance) {
    std::sort(values.begin(), values.end());
    std::vector<double> all;
    for (const double value : values)
        if (all.empty() || value > all.back() + tolerance) all.push_back(value);
    return all;
}

/// How well the gaps between depths fit a law: the median ratio, and the median deviation from it, as a logarithm.
struct LawFit {
    double step = 0, misfit = 0;
};

template <typename Law>
LawFit fitLaw(const std::vector<double>& depths, const Law& law) {
    std::vector<double> ratios;
    for (std::size_t i = 1; i < depths.size(); ++i)
        ratios.push_back((depths[i] - depths[i - 1]) / law((depths[i] + depths[i - 1]) / 2));
    LawFit fit{medianOf(ratios)};
    for (double& ratio : ratios) ratio = std::abs(std::log(ratio / fit.step));
    fit.misfit = medianOf(ratios);
    return fit;
}

/// Share of adjacent pairs with equal depths, along rows or along columns, whichever is smaller.
double sameShare(const DepthFrame& frame, double tolerance) {
    std::size_t pairs[2] = {}, same[2] = {};
    const auto count = [&](int direction, double a, double b) {
        if (a == 0 || b == 0) return;
        ++pairs[direction];
        same[direction] += std::abs(1 / a - 1 / b) <= tolerance;
    };
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 0; column < frame.columns; ++column) {
            const double inverse = frame.inverse[frame.cell(row, column)];
            if (column > 0) count(0, frame.inverse[frame.cell(row, column - 1)], inverse);
            if (row > 0) count(1, frame.inverse[frame.cell(row - 1, column)], inverse);
        }
    if (pairs[0] == 0 || pairs[1] == 0) return 0;
    return std::min(double(same[0]) / double(pairs[0]), double(same[1]) / double(pairs[1]));
}

/// Number of distinct coordinates along an input axis perpendicular to the view axis.
std::size_t distinctAcross(const Cloud& cloud, const RangeGrid& grid, const DepthFrame& frame, double tolerance) {
    const Vec3d across = frame.axis.unitOrthogonal();
    std::vector<double> places;
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kFilteredOut)
            places.push_back(across.dot(cloud.positions[cell].cast<double>() - frame.sensor));
    return distinct(std::move(places), tolerance).size();
}

/// The input axis that a sensor looks along, with sign.
Vec3d viewAxis(const Cloud& cloud, const RangeGrid& grid, const Vec3d& sensor) {
    Vec3d sum = Vec3d::Zero();
    for (const std::uint32_t cell : grid.point_of_cell)
        if (cell < RangeGrid::kFilteredOut) sum += cloud.positions[cell].cast<double>() - sensor;
    int axis = 0;
    sum.cwiseAbs().maxCoeff(&axis);
    return Vec3d::Unit(axis) * (sum[axis] < 0 ? -1 : 1);
}

} // namespace

std::optional<DepthFrame> depthFrameOf(const Cloud& cloud, const RangeGrid& grid) {
    constexpr double kWidestCosine = 0.2588;     // 75 degrees
    constexpr std::uint32_t kMostColumns = 8192; // far above any camera's; limits the memory of strips of rows
    const auto& sensor = cloud.scans[grid.scan].sensor;
    if (!sensor || grid.wraps || grid.columns > kMostColumns) return std::nullopt;
    DepthFrame frame{grid.rows, grid.columns, std::vector<double>(grid.point_of_cell.size()), *sensor - cloud.origin};
    frame.axis = viewAxis(cloud, grid, frame.sensor);
    for (std::size_t i = 0; i < grid.point_of_cell.size(); ++i) {
        const std::uint32_t cell = grid.point_of_cell[i];
        if (cell >= RangeGrid::kFilteredOut) continue;
        const Vec3d from_sensor = cloud.positions[cell].cast<double>() - frame.sensor;
        if (from_sensor.isZero(0)) continue; // some programs write missing depths as zero
        const double depth = from_sensor.dot(frame.axis);
        if (!(depth > kWidestCosine * from_sensor.norm())) return std::nullopt;
        frame.inverse[i] = 1 / depth;
    }
    return frame;
}

std::optional<DepthSteps> findDepthSteps(const Cloud& cloud, const RangeGrid& grid, const DepthFrame& frame) {
    constexpr std::size_t kPointsADepth = 16, kFewestDepths = 16;
    constexpr double kLeastSame = 0.05;  // 0 for unquantised depths, along rows or columns
    constexpr double kWorstMisfit = 0.3; // logarithm; depths are rounded again when written
    std::vector<double> depths;
    for (const double inverse : frame.inverse)
        if (inverse > 0) depths.push_back(1 / inverse);
    const std::size_t points = depths.size();
    if (points == 0) return std::nullopt;
    const double tolerance = kSameDepth * *std::max_element(depths.begin(), depths.end());
    depths = distinct(std::move(depths), tolerance);
    if (depths.size() < kFewestDepths || points < kPointsADepth * depths.size()) return std::nullopt;
    if (sameShare(frame, tolerance) < kLeastSame) return std::nullopt;
    // coordinates written with few digits have steps across the view axis, too
    if (distinctAcross(cloud, grid, frame, tolerance) < 4 * depths.size()) return std::nullopt;
    const LawFit square = fitLaw(depths, [](double depth) { return depth * depth; });
    const LawFit even = fitLaw(depths, [](double) { return 1.0; });
    if (std::min(square.misfit, even.misfit) > kWorstMisfit) return std::nullopt;
    return square.misfit < even.misfit ? DepthSteps{true, square.step} : DepthSteps{false, even.step};
}

} // namespace pointrt
