// SPDX-License-Identifier: GPL-3.0-or-later
// Exact overlap test of a disc, or a ball, and a box.
#pragma once

#include <cmath>

#include "preprocess/octree/quantize.h"

namespace pointrt {

/// An axis-aligned box in cube units.
struct Box {
    Vec3f lo, hi;
};

/// box enlarged so that a test of the flat disc against it covers the disc's blending slab, which reaches slab * radius
/// along the normal to both sides. Balls have no slab.
inline Box growBySlab(const Box& box, const Disc& disc, float slab) {
    const Vec3f reach = slab * disc.radius * disc.normal.cwiseAbs();
    return {box.lo - reach, box.hi + reach};
}

/// Half extents of the disc's bounding box.
inline Vec3f discReach(const Disc& disc) {
    return disc.radius * (1.0f - disc.normal.array().square()).max(0.0f).sqrt().matrix();
}

/// Squared distance from the disc's centre to the part of its plane inside one face of the box, +infinity if the plane
/// misses the face.
/// @param axis normal of the face
/// @param plane coordinate of the face on that axis
float faceDistanceSquared(const Disc& disc, const Box& box, int axis, float plane);

/// Squared distance from the disc's centre to the part of its plane inside the box: 0 if the centre is in the box,
/// +infinity if the plane misses it. Otherwise the closest point lies on a face that has the centre on its outer side
/// (if not, the centre would be closer still), so at most three faces are tested. For a ball, the squared distance from
/// its centre to the box.
float sectionDistanceSquared(const Disc& disc, const Box& box);

/// Whether the disc and the box have a common point.
bool discOverlapsBox(const Disc& disc, const Box& box);

} // namespace pointrt
