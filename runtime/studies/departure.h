// SPDX-License-Identifier: Apache-2.0
// How a ray leaves the surface that a point lies in.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// A point's disc.
struct StudyDisc {
    Vec3 center, normal; ///< unit length
    double radius = 0, noise = 0;
    bool one_sided = false; ///< only what comes from where the normal points to counts
};

/// Whether what comes from that side counts. towards: any length
bool isFaced(const StudyDisc& disc, Vec3 towards);

/// A ray off a disc. Hits on its own surface are no obstacles up to own_reach.
struct Departure {
    Vec3 start, direction; ///< unit length
    Vec3 normal;           ///< of the disc, on the side that the ray leaves by
    double radius = 0;     ///< of the disc
    double own_reach = 0;  ///< along the ray
    double length = 0;     ///< to the eye; infinite to a light
};

/// @param towards a light: unit length
Departure leaveTowards(const StudyDisc& disc, Vec3 towards);
/// Ends at eye, which is not the disc's centre.
Departure leaveFor(const StudyDisc& disc, Vec3 eye);

/// Whether a hit up to own_reach is the surface that the ray left: its disc is parallel to the own one within 60
/// degrees and crossed the same way. hit_normal: unit length, turned to where the ray comes from
bool isOwnSurface(const Departure& ray, Vec3 hit_normal);

} // namespace pointrt
