// SPDX-License-Identifier: Apache-2.0
// A tracer without an octree: every ray against every splat of a .pro. Slow, short, and independent of the shaders.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt::test {

struct ReferenceSplat {
    Vec3 center, normal; ///< input coordinates, unit normal
    double radius = 0;   ///< input units
};

struct ReferenceHit {
    double t = 0; ///< input units along a unit direction
    Vec3 normal;  ///< unit length, towards the ray's origin
    Vec3 position;
    std::size_t splat = 0;
};

struct Reference {
    std::vector<ReferenceSplat> splats;
    double blend_slab = 0;
    bool oriented = true;
};

Reference loadReference(const std::string& path);

/// First disc hit by the ray with t in (0, t_max).
std::optional<ReferenceHit> firstDisc(const Reference& scene, Vec3 origin, Vec3 direction, double t_max = 1e300);

/// The blended surface there, gathered over all splats of the scene.
std::optional<ReferenceHit> firstSurface(const Reference& scene, Vec3 origin, Vec3 direction);

} // namespace pointrt::test
