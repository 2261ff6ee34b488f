// SPDX-License-Identifier: GPL-3.0-or-later
// Ray hits and blending weights of the discs of a leaf, computed as in the tracer (shaders/trace/blend.glsl), eight at
// a time.
#pragma once

#include <array>
#include <vector>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

/// The discs and balls of a leaf as a structure of arrays, padded to full vectors with discs that no ray hits.
struct DiscList {
    std::array<std::vector<float>, 3> center, normal;
    std::vector<float> radius_squared;
    std::array<std::vector<float>, 3> color; ///< 0 to 255
    std::vector<float> kept;                 ///< 1 or 0
    bool oriented = true;
    bool colored = false;   ///< colours are set and compared
    bool has_balls = false; ///< some have the normal 0; these never blend

    std::vector<float> distance; ///< by the last castRay: along the ray, +infinity for a miss
    std::vector<float> weight;   ///< by the last weighAt: 0 for discs that do not blend
    std::vector<float> height;   ///< by the last weighAt: of the point above the disc's plane, on the viewer's side
    std::vector<float> flip;     ///< by the last weighAt: +1 or -1, the sign that flips the normal to the viewer's side

    std::size_t size() const { return count_; }
    void clear();
    void add(const Disc& disc, const Vec3f& rgb, bool keep);
    /// Call it after the last add.
    void pad();
    Vec3f normalOf(std::size_t i) const { return {normal[0][i], normal[1][i], normal[2][i]}; }
    Vec3f colorOf(std::size_t i) const { return {color[0][i], color[1][i], color[2][i]}; }
    float radiusOf(std::size_t i) const { return std::sqrt(radius_squared[i]); }

private:
    void append(const Disc& disc, const Vec3f& rgb, bool keep);
    std::size_t count_ = 0;
};

/// Distances along a ray; +infinity if there is no hit.
struct FirstHits {
    float any;  ///< among all discs
    float kept; ///< among the kept discs
};

/// Sets list.distance for a ray from origin along a unit direction; hits outside [0, t_max] are misses.
FirstHits castRay(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max);

/// Sets weight, height and flip at a point (weights of format/base/blend_weight.h) and returns the sum of weights of
/// the discs that are not kept.
/// @param side unit normal towards the viewer
/// @param front sign that flips oriented normals to that side
float weighAt(DiscList& list, const Vec3f& point, const Vec3f& side, float front);

/// Weighted sums of the blended field.
struct FieldSums {
    float weight = 0, height = 0;
    Vec3f normal = Vec3f::Zero(), color = Vec3f::Zero();
};

/// Sums over all discs, or over the kept ones, at the point of the last weighAt.
FieldSums sumField(const DiscList& list, bool only_kept);

} // namespace pointrt
