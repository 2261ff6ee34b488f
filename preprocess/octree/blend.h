// SPDX-License-Identifier: GPL-3.0-or-later
// First hit and blended surface of a small list of discs, as the tracer computes them (shaders/blend.glsl).
#pragma once

#include <vector>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

struct Ray {
    Vec3f origin;
    Vec3f direction; ///< unit length
};

/// Where a ray meets the blended surface.
struct SurfaceHit {
    float t = 0;      ///< along the ray, cube units
    Vec3f normal;     ///< unit length, towards the ray's origin
    Vec3f color;      ///< 0 to 255 a channel, 0 where the list has no colours
    float radius = 0; ///< of the disc hit first
    std::uint32_t first = 0; ///< index in the list of the disc hit first
};

/// A leaf's discs, with a flag each that says whether it takes part.
struct DiscList {
    std::vector<Disc> discs;
    std::vector<Vec3f> colors; ///< as long as discs, or empty
    std::vector<char> kept;
    bool oriented = true;
};

/// Weight of a disc at a point: 1 at its centre, 0 with zero slope at the rim and at the slab's two faces.
/// height receives the signed distance of the point from the disc's plane.
float blendWeight(const Disc& disc, const Vec3f& point, float& height);

/// Discs blend when their normals differ by less than 60 degrees, so that the two sides of an edge or of a thin
/// sheet stay apart. Without orientation the sign of the normals says nothing and is left out.
constexpr float kSameSideCosine = 0.5f;

/// First hit in [t_min, t_max] among the discs that take part (only_kept) or all, then one Newton step on to the
/// implicit surface sum w_i n_i . (p - c_i) = 0 (Adamson and Alexa 2003). False when no disc is hit.
bool intersectBlended(const DiscList& list, const Ray& ray, float t_min, float t_max, bool only_kept, SurfaceHit& hit);

} // namespace pointrt
