// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "format/set/core_splats.h"
#include "runtime/cast/describe_targets.h"
#include "runtime/cast/translated.h"
#include "runtime/studies/target_points.h"

namespace pointrt {
namespace {

/// Radii that are looked at: the median of so many is that of a percent around the middle.
constexpr std::uint64_t kAsked = 10000;

std::uint64_t splatsOf(const TargetList& list, const Target& target) {
    if (target.tile == kNoTile) return openTarget(list, target).info().splat_count;
    return list.sets[list.files[target.file].set].set.tiles[target.tile].stored;
}

/// Every step-th of a target's.
void addRadii(const TargetList& list, const Target& target, std::uint64_t step, std::vector<double>& radii) {
    if (target.tile == kNoTile) {
        const ProFile file = openTarget(list, target);
        for (std::uint64_t i = 0; i < file.info().splat_count; i += step)
            radii.push_back(target.placement.scale * file.radius(file.splat(i)));
        return;
    }
    const TargetSet& set = list.sets[list.files[target.file].set];
    const SetTile& tile = set.set.tiles[target.tile];
    const double scale = target.placement.scale * cubeOf(set.set, tile).scale;
    for (const pro_splat& splat : coreSplats(set.set, tile, set.folder, 0, step))
        radii.push_back(scale * double{splat.radius});
}

} // namespace

double medianRadius(const std::vector<std::string>& paths) {
    return translated([&] {
        const TargetList list = describeTargets(paths);
        std::uint64_t splats = 0;
        for (const Target& target : list.targets) splats += splatsOf(list, target);
        std::vector<double> radii;
        for (const Target& target : list.targets)
            addRadii(list, target, std::max<std::uint64_t>(1, splats / kAsked), radii);
        if (radii.empty()) return 0.0;
        const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
        std::nth_element(radii.begin(), middle, radii.end());
        return *middle;
    });
}

} // namespace pointrt
