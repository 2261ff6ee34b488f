// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/cells.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// Edge of a cell, as a share of the box's diagonal. A few thousand splats of a surface across the box leave about ten
/// per cell; only at a hundredth of that density are occupied cells no longer adjacent.
constexpr double kCellShare = 1.0 / 20;
constexpr std::uint32_t kEnough = 4;
constexpr double kGrowth = 1.25;
/// Splats farther out are counted in the outermost cells.
constexpr double kMostCells = 1 << 20;

CellPlace placeOf(Vec3 from_low, double edge) {
    const auto along = [&](double way) {
        return static_cast<std::int32_t>(std::clamp(std::floor(way / edge), -kMostCells, kMostCells));
    };
    return {along(from_low.x), along(from_low.y), along(from_low.z)};
}

SampleCells sortedInto(const SceneSample& sample, Vec3 low, double edge) {
    std::vector<CellPlace> of_splats;
    of_splats.reserve(sample.splats.size());
    for (const SampledSplat& splat : sample.splats) of_splats.push_back(placeOf(splat.position - low, edge));
    SampleCells cells;
    cells.places = of_splats;
    std::sort(cells.places.begin(), cells.places.end());
    cells.places.erase(std::unique(cells.places.begin(), cells.places.end()), cells.places.end());
    cells.counts.resize(cells.places.size());
    for (const CellPlace& place : of_splats) {
        const auto found = std::lower_bound(cells.places.begin(), cells.places.end(), place);
        cells.cell_of.push_back(static_cast<std::uint32_t>(found - cells.places.begin()));
        ++cells.counts[cells.cell_of.back()];
    }
    return cells;
}

bool areFilled(const SampleCells& cells) {
    std::size_t among_enough = 0;
    for (const std::uint32_t count : cells.counts) among_enough += count >= kEnough ? count : 0;
    return 2 * among_enough >= cells.cell_of.size() || cells.places.size() == 1;
}

} // namespace

SampleCells cellsOf(const SceneSample& sample) {
    const SampleBox box = denseBox(sample);
    double edge = kCellShare * length(box.high - box.low);
    if (!(edge > 0)) edge = 1; // most splats are at the same place
    SampleCells cells = sortedInto(sample, box.low, edge);
    while (!areFilled(cells)) cells = sortedInto(sample, box.low, edge *= kGrowth);
    return cells;
}

std::vector<double> evenWeights(const SceneSample& sample) {
    const SampleCells cells = cellsOf(sample);
    std::vector<double> weights;
    for (const std::uint32_t cell : cells.cell_of)
        weights.push_back(1.0 / (static_cast<double>(cells.places.size()) * cells.counts[cell]));
    return weights;
}

} // namespace pointrt
