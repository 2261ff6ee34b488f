// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/thinned_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

/// A level with fewer representatives is the last: a point needs some in all directions.
constexpr std::size_t kFewestRepresentatives = 32;

/// In findIsolated.
constexpr std::size_t kInRing = 12;
constexpr float kAlone = 4.5f;
/// Levels of fewer cells show the shape of the whole cloud.
constexpr std::size_t kFewestCells = 64;

/// The edge of the cells that all grids are aligned to. Positions span less than 1, so that they start in one of two
/// such cells, and codes of kMortonBits bits reach down to kFinestExponent.
constexpr int kCoarsestExponent = 1;
constexpr int kFinestExponent = kCoarsestExponent + 1 - kMortonBits;

/// A cell with its points' sum and the point that stands for it so far.
struct Cell {
    std::uint64_t code = 0;
    std::uint32_t point = 0;
    std::uint32_t count = 1;
    Vec3f mean = Vec3f::Zero();
};

/// Every point as a cell of its own, in the order of the cells.
std::vector<Cell> cellsOf(const PointSet& points, int exponent) {
    Vec3f low = points.positions.front();
    for (const Vec3f& position : points.positions) low = low.cwiseMin(position);
    const double coarsest = std::ldexp(1.0, kCoarsestExponent), inverse = std::ldexp(1.0, -exponent);
    const Vec3d base = (low.cast<double>() / coarsest).array().floor().matrix() * coarsest;
    std::vector<Cell> cells(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        const Vec3d place = (points.positions[i].cast<double>() - base) * inverse;
        cells[i] = {mortonCode(std::uint64_t(place.x()), std::uint64_t(place.y()), std::uint64_t(place.z())),
                    std::uint32_t(i), 1, points.positions[i]};
    });
    const auto before = [](const Cell& a, const Cell& b) {
        return a.code != b.code ? a.code < b.code : a.point < b.point;
    };
    if (!std::is_sorted(cells.begin(), cells.end(), before)) tbb::parallel_sort(cells.begin(), cells.end(), before);
    return cells;
}

/// One cell for all those in a range.
Cell merged(const Cell* first, const Cell* last, const std::vector<Vec3f>& positions) {
    Cell whole = *first;
    if (last - first == 1) return whole;
    Vec3d sum = Vec3d::Zero();
    whole.count = 0;
    for (const Cell* cell = first; cell != last; ++cell) {
        sum += double(cell->count) * cell->mean.cast<double>();
        whole.count += cell->count;
    }
    whole.mean = (sum / double(whole.count)).cast<float>();
    float nearest = std::numeric_limits<float>::infinity();
    for (const Cell* cell = first; cell != last; ++cell) {
        const float squared = squaredDistance(positions[cell->point], whole.mean);
        if (squared < nearest) nearest = squared, whole.point = cell->point;
    }
    return whole;
}

/// Merges the cells of equal codes, which follow each other.
std::vector<Cell> mergeEqual(const std::vector<Cell>& cells, const std::vector<Vec3f>& positions) {
    std::vector<Cell> merged_cells;
    for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
        while (end < cells.size() && cells[end].code == cells[begin].code) ++end;
        merged_cells.push_back(merged(&cells[begin], cells.data() + end, positions));
    }
    return merged_cells;
}

ThinnedLevel levelOf(const std::vector<Cell>& cells, const std::vector<Vec3f>& positions, int exponent) {
    std::vector<std::uint32_t> points, first{0};
    std::vector<Vec3f> places;
    for (const Cell& cell : cells) {
        points.push_back(cell.point);
        first.push_back(first.back() + cell.count);
        places.push_back(positions[cell.point]);
    }
    NearestSearch search(places); // its memory moves along
    return {std::ldexp(1.0f, exponent), std::move(points), std::move(first), std::move(places), std::move(search)};
}

} // namespace

ThinnedCloud::ThinnedCloud(const PointSet& points, float finest) {
    int exponent = std::clamp(std::ilogb(finest), kFinestExponent, kCoarsestExponent);
    std::vector<Cell> cells = cellsOf(points, exponent);
    for (const Cell& cell : cells) order_.push_back(cell.point);
    for (; exponent <= kCoarsestExponent; ++exponent) {
        cells = mergeEqual(cells, points.positions);
        levels_.push_back(levelOf(cells, points.positions, exponent));
        if (cells.size() < kFewestRepresentatives) return;
        for (Cell& cell : cells) cell.code >>= 3;
    }
}

std::size_t ThinnedCloud::levelFor(float edge) const {
    std::size_t number = 0;
    while (number < levels_.size() && levels_[number].edge < edge) ++number;
    return number;
}

std::vector<std::uint32_t> ThinnedCloud::findIsolated() const {
    std::vector<std::uint32_t> isolated(order_.size(), 0);
    for (std::size_t number = 0; number < levels_.size(); ++number) {
        const ThinnedLevel& level = levels_[number];
        if (level.points.size() < kFewestCells) break;
        tbb::parallel_for(std::size_t(0), level.points.size(), [&](std::size_t cell) {
            std::array<std::uint32_t, kInRing> found;
            std::array<float, kInRing> squared;
            level.search.nearest(level.positions[cell], found, squared);
            if (squared.back() <= kAlone * kAlone * level.edge * level.edge) return;
            for (std::uint32_t i = level.first[cell]; i < level.first[cell + 1]; ++i)
                isolated[order_[i]] |= std::uint32_t(1) << number;
        });
    }
    return isolated;
}

} // namespace pointrt::surface
