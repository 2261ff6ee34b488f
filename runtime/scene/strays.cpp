// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "runtime/scene/cells.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {
namespace {

/// The share of the sample that a distant part must hold to be shown, if showing it halves the size of everything else.
constexpr double kWorthTwice = 0.05;

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t cell) {
    while (parents[cell] != cell) cell = parents[cell] = parents[parents[cell]];
    return cell;
}

/// The connected components of cells, adjacent by faces, edges or corners: for each cell the first of its component.
std::vector<std::uint32_t> connectedComponents(const std::vector<CellPlace>& places) {
    std::vector<std::uint32_t> parents(places.size());
    std::iota(parents.begin(), parents.end(), 0u);
    for (std::uint32_t i = 0; i < places.size(); ++i)
        for (int n = 0; n < 13; ++n) { // the neighbours with smaller coordinates
            const auto [x, y, z] = places[i];
            const CellPlace neighbour{x + n / 9 - 1, y + n / 3 % 3 - 1, z + n % 3 - 1};
            const auto found = std::lower_bound(places.begin(), places.end(), neighbour);
            if (found == places.end() || *found != neighbour) continue;
            const std::uint32_t a = rootOf(parents, i),
                                b = rootOf(parents, static_cast<std::uint32_t>(found - places.begin()));
            parents[std::max(a, b)] = std::min(a, b);
        }
    for (std::uint32_t i = 0; i < places.size(); ++i) parents[i] = rootOf(parents, i);
    return parents;
}

struct Part {
    SceneSample sample;
    SampleBox box;
};

/// The connected parts of the sample, largest first.
std::vector<Part> partsOf(const SceneSample& sample) {
    const SampleCells cells = cellsOf(sample);
    const std::vector<std::uint32_t> roots = connectedComponents(cells.places);
    std::vector<Part> parts(cells.places.size());
    for (std::size_t i = 0; i < sample.splats.size(); ++i)
        parts[roots[cells.cell_of[i]]].sample.splats.push_back(sample.splats[i]);
    std::erase_if(parts, [](const Part& part) { return part.sample.splats.empty(); });
    for (Part& part : parts) part.box = boundsOf(part.sample);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.sample.splats.size() > b.sample.splats.size(); });
    return parts;
}

SampleBox around(const SampleBox& a, const SampleBox& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

double diagonal(const SampleBox& box) { return length(box.high - box.low); }

} // namespace

SceneSample withoutStrays(const SceneSample& sample) {
    SceneSample kept = sample;
    if (sample.splats.size() < kEachCounts) return kept;
    const std::vector<Part> parts = partsOf(sample);
    kept.splats = parts[0].sample.splats;
    SampleBox box = parts[0].box;
    for (std::size_t p = 1; p < parts.size(); ++p) {
        const std::vector<SampledSplat>& splats = parts[p].sample.splats;
        const double share = static_cast<double>(splats.size()) / static_cast<double>(sample.splats.size());
        const SampleBox larger = around(box, parts[p].box);
        if (kWorthTwice * (diagonal(larger) - diagonal(box)) > share * diagonal(box)) continue;
        kept.splats.insert(kept.splats.end(), splats.begin(), splats.end());
        box = larger;
    }
    return kept;
}

} // namespace pointrt
