// SPDX-License-Identifier: Apache-2.0
// Changes of the closest hits of the same rays by pruning.
#pragma once

#include <span>

#include "tests/support/ray_caster.h"

namespace pointrt::test {

/// A surface counts as moved if it is more than this many local radii from before.
constexpr double kMovedRadii = 0.01;

/// Over the rays that hit in both scenes. Distances are in local radii, angles in degrees.
struct SurfaceChange {
    std::size_t moved_along_ray = 0; ///< rays whose t changed by more than kMovedRadii
    std::size_t moved_along_normal =
        0; ///< rays whose hit is farther than that from the tangent plane of the full surface
    double move_p999 = 0, move_max = 0;                                  ///< along the normal
    double angle_mean = 0, angle_p99 = 0, angle_p999 = 0, angle_max = 0; ///< between the normals
};

struct PruningChange {
    std::size_t rays = 0, hits_full = 0, hits_pruned = 0;
    std::size_t lost = 0, gained = 0; ///< rays that hit in the full scene only, in the pruned scene only
    std::size_t hits_both = 0;
    SurfaceChange flat;    ///< local radius: of the disc in the full scene
    SurfaceChange blended; ///< local radius: blended, in the full scene
};

/// full and pruned are the hits of rays in two scenes over the same splats; all of the same length.
PruningChange measurePruning(std::span<const CubeSplat> splats, std::span<const Ray> rays,
                             std::span<const CastHit> full, std::span<const CastHit> pruned);

} // namespace pointrt::test
