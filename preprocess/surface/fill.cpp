// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/fill.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tuple>

#include "preprocess/surface/scan_lines.h"

namespace pointrt::surface {
namespace {

constexpr double kLeastShare = 1.0 / 50;
constexpr std::array<float, 2> kSides{1.0f, -1.0f};

/// The gap on one side of a point, and the rows it needs.
struct Gap {
    Facing facing;
    std::uint32_t rows = 0; ///< 0: no gap
    float row_step = 0;     ///< distance between rows
};
using Gaps = std::array<Gap, 2>; ///< on both sides

/// A gap with rows as far apart as the filling points along them: the geometric mean of the line's step and the gap, so
/// that the gap gets as many filling points as the line has points. The next line is 2 rows + 1 row steps away; each
/// point fills the rows of its half.
Gap gapWith(const Facing& facing, const ScanLine& line) {
    const float gap = facing.across.norm(), row_step = std::sqrt(gap * line.step);
    const auto rows = std::uint32_t(std::lround((gap / row_step - 1) / 2));
    return {facing, std::clamp(rows, std::uint32_t(1), kMostRows), row_step};
}

std::vector<Gaps> findGaps(const PointGraph& graph, const StageShare& share) {
    const PointSet& points = graph.points;
    std::vector<Gaps> gaps(points.size());
    forEach(points.size(), share, [&](std::size_t i) {
        if (points.hasGivenRadius(i)) return;
        if (!points.planarity.empty() && points.planarity[i] < kSurface) return;
        const auto line = lineAt(graph, i);
        if (!line) return;
        for (std::size_t side = 0; side < kSides.size(); ++side)
            if (const auto facing = facingLine(graph, i, *line, kSides[side])) gaps[i][side] = gapWith(*facing, *line);
    });
    return gaps;
}

/// A cell of a grid that is about two row steps wide, as lines cross some cells at their corners.
struct FillCell {
    int exponent = 0; ///< of the cell's edge
    std::array<std::int32_t, 3> place{};
    std::uint8_t open_sides = 0; ///< 1 if the point is beside two gaps: it comes first
    std::uint32_t point = 0;

    auto cell() const { return std::tie(exponent, place); }
    auto order() const { return std::tie(exponent, place, open_sides, point); }
};

FillCell fillCellOf(const Vec3f& position, const Gaps& sides, std::uint32_t point) {
    FillCell cell;
    cell.exponent = std::ilogb(2 * std::max(sides[0].row_step, sides[1].row_step));
    for (int axis = 0; axis < 3; ++axis)
        cell.place[std::size_t(axis)] = std::int32_t(std::floor(std::ldexp(position[axis], -cell.exponent)));
    cell.open_sides = sides[0].rows == 0 || sides[1].rows == 0;
    cell.point = point;
    return cell;
}

/// Leaves the gaps of one point in each cell.
void thinGaps(const PointSet& points, std::vector<Gaps>& gaps) {
    std::vector<FillCell> cells;
    for (std::size_t i = 0; i < gaps.size(); ++i)
        if (gaps[i][0].rows + gaps[i][1].rows > 0)
            cells.push_back(fillCellOf(points.positions[i], gaps[i], std::uint32_t(i)));
    tbb::parallel_sort(cells.begin(), cells.end(),
                       [](const FillCell& a, const FillCell& b) { return a.order() < b.order(); });
    for (std::size_t i = 1; i < cells.size(); ++i)
        if (cells[i].cell() == cells[i - 1].cell()) gaps[cells[i].point] = {};
}

/// Offset of each point's filling points, then their total.
std::vector<std::uint32_t> countFilling(const std::vector<Gaps>& gaps, std::uint32_t most_rows) {
    std::vector<std::uint32_t> first(gaps.size() + 1, 0);
    for (std::size_t i = 0; i < gaps.size(); ++i)
        first[i + 1] = first[i] + std::min(gaps[i][0].rows, most_rows) + std::min(gaps[i][1].rows, most_rows);
    return first;
}

/// A point between two lines.
struct Between {
    std::size_t base, other;
    Vec3f across;
    float share; ///< of the distance from base to the other line
};

/// Tangent of the surface at one end of the vector across, of the same length.
Vec3f tangentOf(const Vec3f& across, const Vec3f& normal) {
    const Vec3f flat = across - normal.dot(across) * normal;
    return flat * (across.norm() / flat.norm());
}

void place(PointSet& points, std::size_t at, const Between& between) {
    const Vec3f near_normal = points.normals[between.base];
    Vec3f far_normal = points.normals[between.other];
    if (near_normal.dot(far_normal) < 0) far_normal = -far_normal;
    const float s = between.share;
    const Vec3f &across = between.across, leave = tangentOf(across, near_normal),
                arrive = tangentOf(across, far_normal);
    points.positions[at] = points.positions[between.base] + s * s * (3 - 2 * s) * across +
                           s * (1 - s) * (1 - s) * leave - s * s * (1 - s) * arrive;
    const Vec3f slope = 6 * s * (1 - s) * across + (1 - s) * (1 - 3 * s) * leave - s * (2 - 3 * s) * arrive;
    const Vec3f normal = (1 - s) * near_normal + s * far_normal;
    points.normals[at] = (normal - normal.dot(slope) / slope.squaredNorm() * slope).normalized();
    if (points.colors.empty()) return;
    for (std::size_t channel = 0; channel < 3; ++channel)
        points.colors[at][channel] = std::uint8_t(std::lround((1 - s) * float(points.colors[between.base][channel]) +
                                                              s * float(points.colors[between.other][channel])));
}

/// The point that each filling point starts from.
std::vector<std::uint32_t> basesOf(const std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> bases(first.back());
    tbb::parallel_for(std::size_t(0), first.size() - 1, [&](std::size_t i) {
        std::fill(bases.begin() + first[i], bases.begin() + first[i + 1], std::uint32_t(i));
    });
    return bases;
}

void placeAll(PointSet& points, const std::vector<Gaps>& gaps, const std::vector<std::uint32_t>& first,
              std::uint32_t most_rows) {
    tbb::parallel_for(std::size_t(0), gaps.size(), [&](std::size_t i) {
        std::size_t at = gaps.size() + first[i];
        for (const Gap& gap : gaps[i]) {
            const std::uint32_t rows = std::min(gap.rows, most_rows);
            for (std::uint32_t row = 1; row <= rows; ++row)
                place(points, at++, {i, gap.facing.point, gap.facing.across, float(row) / float(2 * rows + 1)});
        }
    });
}

std::size_t countBeside(const std::vector<Gaps>& gaps) {
    return std::size_t(
        std::count_if(gaps.begin(), gaps.end(), [](const Gaps& sides) { return sides[0].rows + sides[1].rows > 0; }));
}

void countRows(const std::vector<Gaps>& gaps, FillCounts& counts) {
    for (std::uint32_t rows = 1; rows <= kMostRows; ++rows) {
        counts[rows] = 0;
        for (const Gaps& sides : gaps) counts[rows] += std::min(sides[0].rows, rows) + std::min(sides[1].rows, rows);
    }
}

} // namespace

std::uint32_t rowsToFill(const FillCounts& counts, std::size_t points) {
    if (counts[0] == 0 || double(counts[0]) < kLeastShare * double(points)) return 0;
    std::uint32_t rows = kMostRows;
    while (rows > 1 && double(counts[rows]) > kMostFilling * double(points)) --rows;
    return rows;
}

std::vector<std::uint32_t> fillBetweenLines(PointGraph& graph, std::optional<std::uint32_t> rows, FillCounts& counts,
                                            const StageShare& share) {
    if (rows == 0u) return {};
    std::vector<Gaps> gaps = findGaps(graph, share);
    counts[0] = countBeside(gaps);
    thinGaps(graph.points, gaps);
    countRows(gaps, counts);
    const std::uint32_t most_rows = rows.value_or(rowsToFill(counts, graph.points.size()));
    if (most_rows == 0 || counts[0] == 0) return {};
    const std::vector<std::uint32_t> first = countFilling(gaps, most_rows);

    std::vector<std::uint32_t> bases = basesOf(first);
    appendRows(graph.points, bases);
    placeAll(graph.points, gaps, first, most_rows);
    graph.connect(graph.lists.k, {share.progress, share.stage, share.to, share.to});
    return bases;
}

} // namespace pointrt::surface
