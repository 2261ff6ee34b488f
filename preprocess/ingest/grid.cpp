// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "preprocess/ingest/sink.h"

namespace pointrt {
namespace {

constexpr bool isPoint(std::uint32_t cell) { return cell < RangeGrid::kFilteredOut; }

/// Whether each point is in one cell only. first: the scan's first point
bool isOneToOne(const RangeGrid& grid, std::size_t first, std::size_t points) {
    std::vector<bool> seen(points);
    for (const std::uint32_t cell : grid.point_of_cell) {
        if (!isPoint(cell)) continue;
        if (seen[cell - first]) return false;
        seen[cell - first] = true;
    }
    return true;
}

/// The angle between two points as seen from the sensor; NaN if one is missing.
double angleBetween(const Cloud& cloud, const Vec3f& sensor, std::uint32_t a, std::uint32_t b) {
    if (!isPoint(a) || !isPoint(b)) return std::numeric_limits<double>::quiet_NaN();
    const Vec3d u = (cloud.positions[a] - sensor).cast<double>(), v = (cloud.positions[b] - sensor).cast<double>();
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Whether the last column is adjacent to the first: in more than half of the rows with points in both columns, these
/// points, seen from the sensor, are hardly further apart than neighbours within the row. A full turn has more than a
/// few columns.
bool wrapsAround(const Cloud& cloud, const Vec3f& sensor, const RangeGrid& grid) {
    constexpr std::uint32_t kFewestColumns = 16;
    constexpr double kStepsApart = 1.75; // steps between neighbours: between 1, and 2 if a column is missing
    if (grid.columns < kFewestColumns) return false;
    std::size_t near = 0, rows = 0;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
        const std::uint32_t first = grid.at(row, 0), last = grid.at(row, grid.columns - 1);
        const double step = angleBetween(cloud, sensor, first, grid.at(row, 1));
        const double gap = angleBetween(cloud, sensor, first, last);
        if (!(step > 0) || std::isnan(gap)) continue;
        ++rows;
        near += gap < kStepsApart * step;
    }
    return 2 * near > rows;
}

/// Why the grid is invalid, or "".
std::string faultOf(const GridBuilder& built, std::size_t first, std::size_t points) {
    constexpr std::uint64_t kCollisionShare = 4; // scanners that record echoes have fewer than one in 4
    if (built.beyond > 0) return fmt::format("{} of its points lie outside its grid", built.beyond);
    if (kCollisionShare * built.collisions > built.occupied + built.collisions)
        return fmt::format("{} of its points lie in occupied cells of its grid", built.collisions);
    if (!isOneToOne(*built.grid, first, points)) return "some of its points lie in two cells of its grid";
    return "";
}

} // namespace

void beginGrid(Sink& sink, std::uint64_t rows, std::uint64_t columns) {
    sink.grid = {};
    std::uint64_t cells = 0;
    const bool overflow = __builtin_mul_overflow(rows, columns, &cells);
    if (rows < 2 || columns < 2 || overflow || cells >= RangeGrid::kFilteredOut) return;
    sink.grid.too_large = !sink.gatherScan(cells);
    if (sink.grid.too_large) return;
    RangeGrid& grid = sink.grid.grid.emplace();
    grid.rows = static_cast<std::uint32_t>(rows);
    grid.columns = static_cast<std::uint32_t>(columns);
    grid.point_of_cell.assign(cells, RangeGrid::kNoPoint);
}

void setCell(Sink& sink, std::uint64_t row, std::uint64_t column, std::uint32_t vertex) {
    GridBuilder& built = sink.grid;
    if (!built.grid || vertex == RangeGrid::kNoPoint) return;
    if (row >= built.grid->rows || column >= built.grid->columns) {
        ++built.beyond;
        return;
    }
    std::uint32_t& cell = built.grid->point_of_cell[row * built.grid->columns + column];
    if (cell != RangeGrid::kNoPoint) {
        ++built.collisions;
        return;
    }
    cell = vertex;
    ++built.occupied;
    built.left_out += vertex == RangeGrid::kFilteredOut;
}

void finishGrid(Sink& sink, const InputFile& input) {
    GridBuilder built = std::exchange(sink.grid, {});
    Cloud& cloud = sink.cloud;
    if (built.too_large || (built.grid && !sink.holdsScan()))
        return sink.note(input, "its grid does not fit in --max-memory, so mixed pixels at edges are kept");
    if (!built.grid || built.occupied == 0 || 2 * built.left_out > built.occupied) return;
    const std::size_t points = sink.scans.back().position_count, first = cloud.positions.size() - points;
    const std::string fault = faultOf(built, first, points);
    if (!fault.empty()) return sink.note(input, fault + ": the scan is read without its grid");
    RangeGrid& grid = cloud.grids.emplace_back(std::move(*built.grid));
    grid.scan = static_cast<std::uint32_t>(cloud.scans.size() - 1);
    if (const auto& sensor = cloud.scans.back().sensor)
        grid.wraps = wrapsAround(cloud, (*sensor - cloud.origin).cast<float>(), grid);
}

} // namespace pointrt
