// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/choose_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "format/base/error.h"
#include "preprocess/cloud/morton.h"

namespace pointrt {
namespace {

/// Merges the cells to cells of twice the edge.
void coarsen(std::vector<CountedCell>& cells) {
    for (CountedCell& each : cells)
        for (std::int64_t& coordinate : each.cell) coordinate >>= 1;
    std::sort(cells.begin(), cells.end(), [](const CountedCell& a, const CountedCell& b) { return a.cell < b.cell; });
    std::size_t kept = 0;
    for (const CountedCell& each : cells) {
        if (kept > 0 && cells[kept - 1].cell == each.cell)
            cells[kept - 1].points += each.points;
        else
            cells[kept++] = each;
    }
    cells.resize(kept);
}

std::uint64_t pointsOf(const std::vector<CountedCell>& cells) {
    std::uint64_t points = 0;
    for (const CountedCell& each : cells) points += each.points;
    return points;
}

/// The value below which a share of all points lies.
double quantile(std::vector<std::pair<double, std::uint64_t>> values, std::uint64_t points, double share) {
    std::sort(values.begin(), values.end());
    std::uint64_t before = 0;
    for (const auto& [value, count] : values)
        if (static_cast<double>(before += count) >= share * static_cast<double>(points)) return value;
    return values.back().first;
}

Vec3d placeOf(const CountedCell& cell) {
    return {static_cast<double>(cell.cell[0]), static_cast<double>(cell.cell[1]), static_cast<double>(cell.cell[2])};
}

/// The range of cells that are not strays.
struct CloudRange {
    Vec3d middle; ///< unit: cells
    double radius = 0;
    bool holds(const CountedCell& cell) const { return (placeOf(cell) - middle).norm() <= radius; }
};

/// The radius is a hundred times the distance of 99% of the points from the median, but at least some cells, so that a
/// cluster in one cell has surroundings.
CloudRange rangeOf(const std::vector<CountedCell>& cells) {
    constexpr double kShare = 0.99, kFar = 100;
    const std::uint64_t points = pointsOf(cells);
    std::vector<std::pair<double, std::uint64_t>> values(cells.size());
    CloudRange range;
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            values[i] = {static_cast<double>(cells[i].cell[static_cast<std::size_t>(axis)]), cells[i].points};
        range.middle[axis] = quantile(values, points, 0.5);
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
        values[i] = {(placeOf(cells[i]) - range.middle).norm(), cells[i].points};
    range.radius = kFar * std::max(1.0, quantile(values, points, kShare));
    return range;
}

/// Removes cells far from all others that have few points together. Returns the number of these points.
std::uint64_t removeStrays(std::vector<CountedCell>& cells) {
    constexpr std::size_t kFewCells = 1 << 16; // whose median is found quickly
    constexpr std::uint64_t kFewPoints = 100;  // too few for a useful tile
    std::vector<CountedCell> coarse = cells;
    int doublings = 0;
    for (; coarse.size() > kFewCells; ++doublings) coarsen(coarse);
    const CloudRange range = rangeOf(coarse);
    std::uint64_t far = 0;
    for (const CountedCell& each : coarse) far += range.holds(each) ? 0 : each.points;
    if (far == 0 || far > kFewPoints) return 0;
    std::erase_if(cells, [&](CountedCell each) {
        for (std::int64_t& coordinate : each.cell) coordinate >>= doublings;
        return !range.holds(each);
    });
    return far;
}

struct Corners {
    GridCell low, high;
    std::int64_t widest() const {
        return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}) + 1; // cells
    }
};

Corners cornersOf(const std::vector<CountedCell>& cells) {
    Corners corners{cells.front().cell, cells.front().cell};
    for (const CountedCell& each : cells)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            corners.low[axis] = std::min(corners.low[axis], each.cell[axis]);
            corners.high[axis] = std::max(corners.high[axis], each.cell[axis]);
        }
    return corners;
}

/// Cells along a Morton curve, with cumulative point counts.
struct Curve {
    std::vector<std::uint64_t> codes;
    std::vector<std::uint64_t> before; ///< [cells + 1]
};

Curve curveOf(const std::vector<CountedCell>& cells, const GridCell& low) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sorted;
    for (const CountedCell& each : cells) {
        const auto along = [&](std::size_t axis) { return static_cast<std::uint64_t>(each.cell[axis] - low[axis]); };
        sorted.emplace_back(mortonCode(along(0), along(1), along(2)), each.points);
    }
    std::sort(sorted.begin(), sorted.end());
    Curve curve{{}, {0}};
    for (const auto& [code, points] : sorted) {
        curve.codes.push_back(code);
        curve.before.push_back(curve.before.back() + points);
    }
    return curve;
}

/// Splits cells of the octree. Levels count up from the counted cells until all tiles are known.
struct Splitter {
    const Curve& curve;
    double edge; ///< of a counted cell
    std::uint64_t most, limit;
    std::vector<PlanTile> tiles;

    /// Counted cells [first, end) lie in the octree's cell whose lowest corner has the code.
    void split(std::size_t first, std::size_t end, std::uint64_t code, std::uint32_t level) {
        if (first == end) return;
        const std::uint64_t points = curve.before[end] - curve.before[first];
        if (points <= most || level == 0) return addTile(first, end, code, level, points);
        const std::uint64_t span = std::uint64_t{1} << (3 * (level - 1)); // number of codes in a child
        for (std::uint64_t child = 0; child < 8; ++child) {
            const auto next = std::lower_bound(curve.codes.begin() + std::ptrdiff_t(first),
                                               curve.codes.begin() + std::ptrdiff_t(end), code + (child + 1) * span);
            const auto past = static_cast<std::size_t>(next - curve.codes.begin());
            split(first, past, code + child * span, level - 1);
            first = past;
        }
    }

    void addTile(std::size_t first, std::size_t end, std::uint64_t code, std::uint32_t level, std::uint64_t points) {
        if (limit > 0 && points > limit)
            throw Error(ExitCode::kCannotRun,
                        fmt::format("{} points lie within {:g} of each other, more than fit in a tile with this "
                                    "--max-memory; raise it, or use --thin",
                                    points, edge));
        const auto along = [&](int axis) { return static_cast<std::int32_t>(collectBits(code >> axis) >> level); };
        tiles.push_back({level, {along(0), along(1), along(2)}, points, spacingOf(first, end, level)});
    }

    /// Estimated from the area of a surface through cells wide enough to hold several points on average. If cells are
    /// narrower, many of those that the surface passes through are empty, and the narrowest have a single point each.
    double spacingOf(std::size_t first, std::size_t end, std::uint32_t level) const {
        constexpr std::uint64_t kPointsEach = 4; // leaves 2% of the cells along a surface empty
        const std::uint64_t points = curve.before[end] - curve.before[first];
        std::uint64_t cells = end - first;
        std::uint32_t coarser = 0;
        while (coarser < level && points < kPointsEach * cells) cells = countCells(first, end, ++coarser);
        const double width = std::ldexp(edge, static_cast<int>(coarser));
        return width * std::sqrt(static_cast<double>(cells) / static_cast<double>(points));
    }

    /// Number of cells, `level` levels above the counted ones, that [first, end) lie in.
    std::uint64_t countCells(std::size_t first, std::size_t end, std::uint32_t levels_above) const {
        std::uint64_t cells = 1;
        for (std::size_t i = first + 1; i < end; ++i)
            cells += curve.codes[i] >> 3 * levels_above != curve.codes[i - 1] >> 3 * levels_above;
        return cells;
    }
};

/// Groups tiles into blocks, so that a country of 10^11 points has no more jobs than workflow engines handle.
void chooseBlocks(const TileChoice& choice, SetPlan& plan) {
    constexpr std::uint64_t kTilesEach = 4, kMostBlocks = 2000;
    const std::uint64_t points = std::max(kTilesEach * choice.points_per_tile, plan.points / kMostBlocks + 1);
    std::uint64_t in_block = 0;
    plan.first_tile_of_block = {0};
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        if (in_block >= points) {
            plan.first_tile_of_block.push_back(i);
            in_block = 0;
        }
        in_block += plan.tiles[i].points;
    }
    plan.first_tile_of_block.push_back(static_cast<std::uint32_t>(plan.tiles.size()));
}

std::uint32_t levelsFor(std::int64_t cells) {
    std::uint32_t levels = 0;
    while ((std::int64_t{1} << levels) < cells) ++levels;
    return levels;
}

} // namespace

void chooseTiles(std::vector<CountedCell> cells, double edge, const TileChoice& choice, SetPlan& plan) {
    plan.points_stray = choice.leaves_out_strays ? removeStrays(cells) : 0;
    plan.points = pointsOf(cells);
    while (cornersOf(cells).widest() > (std::int64_t{1} << kMortonBits)) {
        coarsen(cells);
        edge *= 2;
    }
    const Corners corners = cornersOf(cells);
    const Curve curve = curveOf(cells, corners.low);
    const std::uint32_t root = levelsFor(corners.widest());
    const std::uint64_t about = choice.points_per_tile + choice.points_per_tile / 2;
    const std::uint64_t most = choice.most_points > 0 ? std::min(about, choice.most_points) : about;
    Splitter splitter{curve, edge, most, choice.most_points, {}};
    splitter.split(0, curve.codes.size(), 0, root);

    plan.tiles = std::move(splitter.tiles);
    std::uint32_t finest = root;
    for (const PlanTile& tile : plan.tiles) finest = std::min(finest, tile.level);
    for (PlanTile& tile : plan.tiles) tile.level -= finest;
    plan.edge = std::ldexp(edge, static_cast<int>(finest));
    plan.levels = root - finest + 1;
    for (int axis = 0; axis < 3; ++axis)
        plan.lattice_origin[axis] = edge * static_cast<double>(corners.low[static_cast<std::size_t>(axis)]);
    chooseBlocks(choice, plan);
}

} // namespace pointrt
