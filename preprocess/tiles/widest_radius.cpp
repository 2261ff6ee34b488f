// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/widest_radius.h"

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "preprocess/surface/radii.h"
#include "preprocess/tiles/splat_file.h"

namespace pointrt {

namespace {

/// Positive floats sort by their bits. The first pass counts the upper halves, the second the lower halves of those
/// with the selected upper half.
constexpr std::uint32_t kHalfBits = 16, kHalves = 1u << kHalfBits;

using Counts = std::vector<std::uint64_t>;

void forRadii(const TileTree& tree, const std::string& folder, const std::function<void(std::uint32_t bits)>& use) {
    for (const TileKey& tile : tree.tiles())
        if (tree.isOriginal(tile))
            for (const float radius : readRadii(folder, tile)) use(std::bit_cast<std::uint32_t>(radius));
}

/// The bin that contains a rank. place: on return the rank within the bin
std::uint32_t findCount(const Counts& counts, std::uint64_t& place) {
    std::uint32_t at = 0;
    for (; place >= counts[at]; ++at) place -= counts[at];
    return at;
}

} // namespace

float findWidestRadius(const TileTree& tree, const std::string& splats_folder) {
    std::uint64_t splats = 0;
    Counts upper(kHalves), lower(kHalves);
    forRadii(tree, splats_folder, [&](std::uint32_t bits) {
        ++upper[bits >> kHalfBits];
        ++splats;
    });
    const auto rule = surface::radiusLimitRule(splats);
    if (!rule) return std::numeric_limits<float>::infinity();
    std::uint64_t place = rule->place;
    const std::uint32_t half = findCount(upper, place);
    forRadii(tree, splats_folder,
             [&](std::uint32_t bits) { lower[bits & (kHalves - 1)] += bits >> kHalfBits == half; });
    return rule->times * std::bit_cast<float>(half << kHalfBits | findCount(lower, place));
}

float widestRadius(const SetPlan& plan, const TileTree& tree) {
    if (plan.schema.radii)
        return std::numeric_limits<float>::infinity(); // given radii are not limited: see CloudStatistics
    if (const auto kept = readWidestRadius(plan)) return *kept;
    const float widest = findWidestRadius(tree, splatsFolder(plan));
    writeWidestRadius(plan, widest);
    return widest;
}

} // namespace pointrt
