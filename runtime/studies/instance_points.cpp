// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/instance_points.h"

#include <string>

#include "format/base/error.h"
#include "format/set/open_tile.h"

namespace pointrt {

ProFile openInstance(const InstanceList& list, const CastInstance& instance) {
    const InstanceFile& file = list.files[instance.file];
    if (instance.tile != kNoTile) {
        const InstanceSet& set = list.sets[file.set];
        return openTile(set.set, set.set.tiles[instance.tile], set.folder, PRO_OPEN_SKIP_CHECKSUMS);
    }
    try {
        return ProFile(file.path, PRO_OPEN_SKIP_CHECKSUMS);
    } catch (const ProError& error) {
        throw Error(exitCodeOf(error.result), error.what());
    }
}

void requireCount(const InstanceList& list, const CastInstance& instance, std::uint64_t points) {
    if (instance.tile == kNoTile) return;
    const InstanceFile& file = list.files[instance.file];
    const std::uint64_t expected = list.sets[file.set].set.tiles[instance.tile].splats;
    if (points != expected)
        throw Error(ExitCode::kBadInput, file.path + ": has " + std::to_string(points) +
                                             " splats in its core, but set.json states " + std::to_string(expected));
}

void addPoint(const ProFile& file, std::size_t number, const Placement& placement, ScanPoints& points) {
    const pro_splat splat = file.splat(number);
    const std::array<double, 3> at = file.position(splat);
    const Vec3 position = placed(placement, {at[0], at[1], at[2]});
    const Vec3 normal = turned(placement, {double{splat.normal[0]}, double{splat.normal[1]}, double{splat.normal[2]}});
    const double radius = placement.scale * file.radius(splat);
    points.positions.insert(points.positions.end(), {position.x, position.y, position.z});
    points.normals.insert(points.normals.end(),
                          {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)});
    if (const auto noise = file.noise(); !noise.empty()) {
        points.noise.resize(points.radii.size()); // 0 for earlier files without noise
        points.noise.push_back(static_cast<float>(radius * noise[number] / PRO_NOISE_STEPS));
    } else if (!points.noise.empty()) {
        points.noise.push_back(0);
    }
    points.radii.push_back(static_cast<float>(radius));
}

} // namespace pointrt
