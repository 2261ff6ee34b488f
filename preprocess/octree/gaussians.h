// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians to the sections of a .pro: packed as they are, and listed in an octree of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/cloud/gaussians.h"
#include "preprocess/octree/octree.h"

namespace pointrt {

/// The points and attributes moved out of a cloud of Gaussians.
struct GaussianCloud {
    Cloud points; ///< positions, normals, radii, colours, and the attributes of Gaussians
    GaussianColumns columns;
};

/// Moves the Gaussians out of a cloud, which keeps its other attributes. Throws Error kBadInput if it mixes Gaussians
/// and points.
GaussianCloud takeGaussians(Cloud& cloud);

/// The Gaussians as splats in Morton order: discs across their shortest axes for readers without support for Gaussians.
/// Merges none. The cube holds all centres, and the ellipsoids of all but the largest Gaussians.
PackedSplats packGaussianSplats(const GaussianCloud& gaussians);

/// The leaves of the octree of centres, without references.
Octree buildCenterOctree(PackedSplats& splats);

/// The sections GAUS, GHRM, GNOD, GLST and GEXA.
struct GaussianSections {
    pro_gaussians view{}; ///< points to the vectors below
    std::vector<std::uint32_t> words;
    std::vector<std::int8_t> harmonics;
    std::vector<std::uint32_t> nodes, lists;
    std::vector<pro_exact_gaussian> exact;
};

/// Packs the Gaussians in the order of the splats.
/// @param splats of packGaussianSplats of the same Gaussians
GaussianSections packGaussians(const GaussianCloud& gaussians, const PackedSplats& splats);

} // namespace pointrt
