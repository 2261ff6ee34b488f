// SPDX-License-Identifier: Apache-2.0
// The discs and balls of a .pro as the shaders decode them, in cube units and double.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt::test {

struct CubeSplat {
    Vec3 center, normal; ///< cube units; unit normal as stored, 0 for a ball
    double radius = 0;   ///< cube units
};

/// All splats of the .pro at path, in its order. Throws Error kBadInput.
std::vector<CubeSplat> loadCubeSplats(const std::string& path);

struct Sphere {
    Vec3 center;
    double radius = 0;
};

/// Sphere around the centre of the bounding box that contains every disc. splats must not be empty.
Sphere boundingSphere(std::span<const CubeSplat> splats);

/// Intersection of a ray with the plane of a disc.
struct DiscHit {
    double t = 0;     ///< in lengths of direction; infinite if the ray is parallel to the plane
    double share = 0; ///< distance from the centre over the radius: a hit if below 1
    double slope = 0; ///< |cosine| between direction and normal
};

/// Computed in double.
DiscHit meetPlane(const CubeSplat& splat, Vec3 origin, Vec3 direction);

} // namespace pointrt::test
