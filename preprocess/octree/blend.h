// SPDX-License-Identifier: GPL-3.0-or-later
// Ray hits and blending weights of a leaf's discs, as the tracer computes them (shaders/blend.glsl). Arrays run over
// the discs and loops have no branches, so that the compiler turns them into SIMD.
#pragma once

#include <array>
#include <vector>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

/// Discs blend when their normals differ by less than 60 degrees, so that the two sides of an edge or of a thin
/// sheet stay apart. Without orientation the sign of the normals says nothing and is left out.
constexpr float kSameSideCosine = 0.5f;

/// A leaf's discs, one array a coordinate, and room for what is computed of them.
struct DiscList {
    std::array<std::vector<float>, 3> center, normal;
    std::vector<float> radius_squared;
    std::array<std::vector<float>, 3> color; ///< 0 to 255; zeros where the cloud has none
    std::vector<char> kept;
    bool oriented = true;

    std::vector<float> distance; ///< of the last castRay: along the ray, +infinity where missed
    std::vector<float> weight;   ///< of the last weighAt, 0 where a disc does not blend
    std::vector<float> height;   ///< of the last weighAt: point over the disc's plane, on the viewer's side
    std::vector<float> turn;     ///< of the last weighAt: +1 or -1, turns the normal to the viewer's side

    std::size_t size() const { return radius_squared.size(); }
    void clear();
    void add(const Disc& disc, const Vec3f& rgb, bool keep);
    Vec3f normalOf(std::size_t i) const { return {normal[0][i], normal[1][i], normal[2][i]}; }
};

/// Fills list.distance for a ray from origin along a unit direction; hits before 0 or beyond t_max count as missed.
void castRay(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max);

/// Fills weight, height and turn at a point. side is a unit normal towards the viewer; front turns oriented normals to
/// that side. A weight is (1 - d^2/r^2)^2 (1 - h^2/s^2)^2: zero with zero slope at the rim and at the slab's faces.
void weighAt(DiscList& list, const Vec3f& point, const Vec3f& side, float front);

} // namespace pointrt
