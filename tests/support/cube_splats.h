// SPDX-License-Identifier: Apache-2.0
// A .pro's discs as the shaders see them: decoded, in cube units, in double.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt::test {

struct CubeSplat {
    Vec3 center, normal; ///< cube units; unit normal as stored
    double radius = 0;   ///< cube units
};

/// All splats of the .pro at path, in its order. Throws Error kBadInput.
std::vector<CubeSplat> loadCubeSplats(const std::string& path);

struct Sphere {
    Vec3 center;
    double radius = 0;
};

/// Around the middle of the discs' bounding box; holds every disc whole. splats must not be empty.
Sphere boundingSphere(std::span<const CubeSplat> splats);

/// Where a ray meets a disc's plane.
struct DiscHit {
    double t = 0;     ///< in lengths of direction; infinite where the ray runs along the plane
    double share = 0; ///< distance from the centre over the radius: the disc is hit where this is below 1
    double slope = 0; ///< |cosine| between direction and normal
};

/// In double throughout.
DiscHit meetPlane(const CubeSplat& splat, Vec3 origin, Vec3 direction);

} // namespace pointrt::test
