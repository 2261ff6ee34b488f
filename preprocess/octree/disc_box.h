// SPDX-License-Identifier: GPL-3.0-or-later
// Does a disc meet a box? Exactly, not by bounding boxes.
#pragma once

#include <cmath>

#include "preprocess/octree/quantize.h"

namespace pointrt {

/// An axis-aligned box in cube units.
struct Box {
    Vec3f lo, hi;
};

/// box grown so that testing the flat disc against it covers the disc's blending slab: every point within
/// slab * radius of the disc along its normal that lies in box is then met.
inline Box growBySlab(const Box& box, const Disc& disc, float slab) {
    const Vec3f reach = slab * disc.radius * disc.normal.cwiseAbs();
    return {box.lo - reach, box.hi + reach};
}

/// Half extents of the disc's bounding box.
inline Vec3f discReach(const Disc& disc) {
    return disc.radius * (1.0f - disc.normal.array().square()).max(0.0f).sqrt().matrix();
}

/// Squared distance from the disc's centre to the part of its plane inside one face of the box,
/// +infinity where the plane misses the face. axis names the face, plane its coordinate.
float faceDistanceSquared(const Disc& disc, const Box& box, int axis, float plane);

/// Squared distance from the disc's centre to the part of its plane inside the box: 0 where the centre is in the box,
/// +infinity where the plane misses it. The nearest point of the plane's section of the box lies on a face whose side
/// the centre violates (else the centre were nearer still), so at most three faces are looked at.
float sectionDistanceSquared(const Disc& disc, const Box& box);

/// True when the disc and the box share a point.
bool discMeetsBox(const Disc& disc, const Box& box);

} // namespace pointrt
