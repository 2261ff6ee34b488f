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

/// Positive floats have the order of their bits, of which a first reading counts the upper half, and a second one the
/// lower half of those that share the upper half looked for.
constexpr std::uint32_t kHalfBits = 16, kHalves = 1u << kHalfBits;

using Counts = std::vector<std::uint64_t>;

void forRadii(const TileTree& tree, const std::string& folder, const std::function<void(std::uint32_t bits)>& heard) {
    for (const TileKey& tile : tree.tiles())
        if (tree.isOriginal(tile))
            for (const float radius : readRadii(folder, tile)) heard(std::bit_cast<std::uint32_t>(radius));
}

/// Which count the place falls into; place: what is left of it there.
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
    if (plan.schema.radii) return std::numeric_limits<float>::infinity(); // whose own nothing limits: CloudTraits
    if (const auto kept = readWidestRadius(plan)) return *kept;
    const float widest = findWidestRadius(tree, splatsFolder(plan));
    writeWidestRadius(plan, widest);
    return widest;
}

} // namespace pointrt
