// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/target_points.h"

#include <string>

#include "format/base/error.h"
#include "format/set/open_tile.h"

namespace pointrt {

ProFile openTarget(const TargetList& list, const Target& target) {
    const TargetFile& file = list.files[target.file];
    if (target.tile != kNoTile) {
        const TargetSet& set = list.sets[file.set];
        return openTile(set.set, set.set.tiles[target.tile], set.folder, PRO_OPEN_SKIP_CHECKSUMS);
    }
    try {
        return ProFile(file.path, PRO_OPEN_SKIP_CHECKSUMS);
    } catch (const ProError& error) {
        throw Error(exitCodeOf(error.result), error.what());
    }
}

void requireCount(const TargetList& list, const Target& target, std::uint64_t points) {
    if (target.tile == kNoTile) return;
    const TargetFile& file = list.files[target.file];
    const std::uint64_t promised = list.sets[file.set].set.tiles[target.tile].splats;
    if (points != promised)
        throw Error(ExitCode::kBadInput, file.path + ": has " + std::to_string(points) +
                                             " splats in its core, where set.json says " + std::to_string(promised));
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
        points.noise.resize(points.radii.size()); // of files before that had none
        points.noise.push_back(static_cast<float>(radius * noise[number] / PRO_NOISE_STEPS));
    } else if (!points.noise.empty()) {
        points.noise.push_back(0);
    }
    points.radii.push_back(static_cast<float>(radius));
}

} // namespace pointrt
