// SPDX-License-Identifier: Apache-2.0
// Rays from points of a surface to lights and observers, offset against self-intersection.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// A point's disc.
struct StudyDisc {
    Vec3 center, normal; ///< unit length
    double radius = 0, noise = 0;
    bool one_sided = false; ///< only the side that the normal points to receives light
};

/// Whether the disc can receive light from this direction, of any length.
bool isFacing(const StudyDisc& disc, Vec3 towards);

/// A ray that leaves a disc. Hits on the disc's own surface up to self_distance do not block it.
struct VisibilityRay {
    Vec3 start, direction;    ///< unit length
    Vec3 normal;              ///< of the disc, on the side of the ray
    double radius = 0;        ///< of the disc
    double self_distance = 0; ///< self-intersection distance along the ray
    double length = 0;        ///< to the observer; infinite to a light
};

/// @param towards the light, unit length
VisibilityRay rayToLight(const StudyDisc& disc, Vec3 towards);
/// @param eye not the centre of the disc
VisibilityRay rayToObserver(const StudyDisc& disc, Vec3 eye);

/// Whether a hit up to self_distance is a self-intersection: a disc within 60 degrees of parallel to the ray's own,
/// crossed from below.
/// @param hit_normal unit length, towards the origin of the ray
bool isSelfIntersection(const VisibilityRay& ray, Vec3 hit_normal);

} // namespace pointrt
