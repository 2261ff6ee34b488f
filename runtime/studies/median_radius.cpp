// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "format/set/core_splats.h"
#include "runtime/cast/describe_instances.h"
#include "runtime/cast/translated.h"
#include "runtime/studies/instance_points.h"

namespace pointrt {
namespace {

/// Size of the sample: its median lies within a percent of the middle of all radii, by rank.
constexpr std::uint64_t kSampled = 10000;

std::uint64_t splatsOf(const InstanceList& list, const CastInstance& instance) {
    if (instance.tile == kNoTile) return openInstance(list, instance).info().splat_count;
    return list.sets[list.files[instance.file].set].set.tiles[instance.tile].stored;
}

/// Appends the radius of every step-th splat.
void addRadii(const InstanceList& list, const CastInstance& instance, std::uint64_t step, std::vector<double>& radii) {
    if (instance.tile == kNoTile) {
        const ProFile file = openInstance(list, instance);
        for (std::uint64_t i = 0; i < file.info().splat_count; i += step)
            radii.push_back(instance.placement.scale * file.radius(file.splat(i)));
        return;
    }
    const InstanceSet& set = list.sets[list.files[instance.file].set];
    const SetTile& tile = set.set.tiles[instance.tile];
    const double scale = instance.placement.scale * cubeOf(set.set, tile).scale;
    for (const pro_splat& splat : coreSplats(set.set, tile, set.folder, 0, step))
        radii.push_back(scale * double{splat.radius});
}

} // namespace

double medianRadius(const std::vector<std::string>& paths) {
    return translated([&] {
        const InstanceList list = describeInstances(paths);
        std::uint64_t splats = 0;
        for (const CastInstance& instance : list.instances) splats += splatsOf(list, instance);
        std::vector<double> radii;
        for (const CastInstance& instance : list.instances)
            addRadii(list, instance, std::max<std::uint64_t>(1, splats / kSampled), radii);
        if (radii.empty()) return 0.0;
        const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
        std::nth_element(radii.begin(), middle, radii.end());
        return *middle;
    });
}

} // namespace pointrt
