// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/plane_windows.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

namespace pointrt {
namespace {

/// WindowSums over cells: 1, row, column, value, and the products rr rc cc rv cv vv of two of these.
using WindowSums = Eigen::Array<double, 10, 1>;

WindowSums sumsOf(double row, double column, double value) {
    WindowSums sums;
    sums << 1, row, column, value, row * row, row * column, column * column, row * value, column * value, value * value;
    return sums;
}

/// The least-squares plane through the cells, at one of them.
PlaneValue planeAt(const WindowSums& sums, double row, double column) {
    constexpr double kNarrow = 0.2; // the variance of a row and the next is 1/4
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const WindowSums mean = sums / sums[0];
    const double rr = mean[4] - mean[1] * mean[1], rc = mean[5] - mean[1] * mean[2], cc = mean[6] - mean[2] * mean[2];
    const double rv = mean[7] - mean[1] * mean[3], cv = mean[8] - mean[2] * mean[3], vv = mean[9] - mean[3] * mean[3];
    const double determinant = rr * cc - rc * rc;
    if (!(rr > kNarrow && cc > kNarrow && determinant > kNarrow * kNarrow)) return {kNone, kNone};
    const double by_row = (rv * cc - cv * rc) / determinant, by_column = (cv * rr - rv * rc) / determinant;
    return {mean[3] + by_row * (row - mean[1]) + by_column * (column - mean[2]),
            std::sqrt(std::max(0.0, vv - by_row * rv - by_column * cv))};
}

/// Integral image of rows [begin, end) of a frame. Coordinates are relative to its middle, to stay small.
struct Strip {
    const DepthFrame& frame;
    const Arms& arms;
    int radius;
    std::uint32_t begin, end;
    double zero;                        ///< subtracted from values, to keep sums small
    std::vector<WindowSums> above = {}; ///< [end - begin + 1][columns]: sums over the one-row windows above each cell

    double rowOf(std::uint32_t row) const { return double(row) - double(begin); }
    double columnOf(std::uint32_t column) const { return double(column) - double(frame.columns / 2); }
    int armOf(const std::vector<std::uint8_t>& arm, std::size_t cell) const { return std::min(int(arm[cell]), radius); }

    void sumUp() {
        above.assign(std::size_t{end - begin + 1} * frame.columns, WindowSums::Zero());
        std::vector<WindowSums> before(frame.columns + 1);
        before[0].setZero();
        for (std::uint32_t row = begin; row < end; ++row) {
            for (std::uint32_t column = 0; column < frame.columns; ++column) {
                const double inverse = frame.inverse[frame.cell(row, column)];
                before[column + 1] = before[column];
                if (inverse > 0) before[column + 1] += sumsOf(rowOf(row), columnOf(column), inverse - zero);
            }
            WindowSums* const sums = above.data() + std::size_t{row - begin} * frame.columns;
            for (std::uint32_t column = 0; column < frame.columns; ++column) {
                const std::size_t cell = frame.cell(row, column);
                sums[frame.columns + column] = sums[column] + before[column + 1 + armOf(arms.right, cell)] -
                                               before[column - armOf(arms.left, cell)];
            }
        }
    }

    PlaneValue planeOf(std::uint32_t row, std::uint32_t column) const {
        const std::size_t cell = frame.cell(row, column);
        const std::uint32_t top = row - begin - armOf(arms.up, cell), below = row - begin + 1 + armOf(arms.down, cell);
        const WindowSums sums =
            above[std::size_t{below} * frame.columns + column] - above[std::size_t{top} * frame.columns + column];
        PlaneValue plane = planeAt(sums, rowOf(row), columnOf(column));
        plane.value += zero;
        return plane;
    }
};

/// Lengths of arms along a row or column of cells, in both directions.
template <typename Inverse, typename Store>
void measureArms(std::uint32_t count, const DepthSteps& steps, double jump, const Inverse& inverse,
                 const Store& store) {
    for (const bool forward : {true, false}) {
        int length = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t here = forward ? i : count - 1 - i;
            const double value = inverse(here), last = i == 0 ? 0 : inverse(forward ? here - 1 : here + 1);
            const bool continues =
                value > 0 && last > 0 && std::abs(value - last) <= jump * steps.at(std::min(value, last));
            length = continues ? std::min(length + 1, Arms::kLongest) : 0;
            store(here, forward, std::uint8_t(length));
        }
    }
}

} // namespace

Arms findArms(const DepthFrame& frame, const DepthSteps& steps, double jump) {
    Arms arms;
    for (auto* each : {&arms.left, &arms.right, &arms.up, &arms.down}) each->resize(frame.inverse.size());
    tbb::parallel_for(std::uint32_t{0}, frame.rows, [&](std::uint32_t row) {
        measureArms(
            frame.columns, steps, jump, [&](std::uint32_t i) { return frame.inverse[frame.cell(row, i)]; },
            [&](std::uint32_t i, bool forward, std::uint8_t length) {
                (forward ? arms.left : arms.right)[frame.cell(row, i)] = length;
            });
    });
    tbb::parallel_for(std::uint32_t{0}, frame.columns, [&](std::uint32_t column) {
        measureArms(
            frame.rows, steps, jump, [&](std::uint32_t i) { return frame.inverse[frame.cell(i, column)]; },
            [&](std::uint32_t i, bool forward, std::uint8_t length) {
                (forward ? arms.up : arms.down)[frame.cell(i, column)] = length;
            });
    });
    return arms;
}

void fitPlanes(const DepthFrame& frame, const Arms& arms, int radius, std::uint32_t first, std::uint32_t last,
               std::vector<PlaneValue>& values) {
    const auto reach = std::uint32_t(radius);
    const std::size_t middle = frame.cell((first + last) / 2, frame.columns / 2);
    Strip strip{
        frame, arms, radius, first - std::min(first, reach), std::min(frame.rows, last + reach), frame.inverse[middle]};
    strip.sumUp();
    values.clear();
    for (std::uint32_t row = first; row < last; ++row)
        for (std::uint32_t column = 0; column < frame.columns; ++column) values.push_back(strip.planeOf(row, column));
}

} // namespace pointrt
