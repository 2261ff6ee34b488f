// SPDX-License-Identifier: GPL-3.0-or-later
// Ray hits and blending weights of a leaf's discs, as the tracer computes them (shaders/trace/blend.glsl), eight at a
// time.
#pragma once

#include <array>
#include <vector>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

/// A leaf's discs, one array a coordinate, padded to whole vectors with discs that nothing hits.
struct DiscList {
    std::array<std::vector<float>, 3> center, normal;
    std::vector<float> radius_squared;
    std::array<std::vector<float>, 3> color; ///< 0 to 255
    std::vector<float> kept;                 ///< 1 or 0
    bool oriented = true;
    bool colored = false; ///< color is filled in and compared

    std::vector<float> distance; ///< of the last castRay: along the ray, +infinity where missed
    std::vector<float> weight;   ///< of the last weighAt, 0 where a disc does not blend
    std::vector<float> height;   ///< of the last weighAt: point over the disc's plane, on the viewer's side
    std::vector<float> turn;     ///< of the last weighAt: +1 or -1, turns the normal to the viewer's side

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

/// Distances along a ray, +infinity where nothing is hit.
struct FirstHits {
    float any;  ///< of all discs
    float kept; ///< of those kept
};

/// Fills list.distance for a ray from origin along a unit direction; hits before 0 or beyond t_max count as missed.
FirstHits castRay(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max);

/// Fills weight, height and turn at a point and returns the weight of the discs not kept. side is a unit normal
/// towards the viewer; front turns oriented normals to that side.
/// Weights are those of format/base/blend_weight.h.
float weighAt(DiscList& list, const Vec3f& point, const Vec3f& side, float front);

/// Weighted sums of the field over some of the discs.
struct FieldSums {
    float weight = 0, height = 0;
    Vec3f normal = Vec3f::Zero(), color = Vec3f::Zero();
};

/// The sums over all discs, or over those kept, at the point of the last weighAt.
FieldSums sumField(const DiscList& list, bool only_kept);

} // namespace pointrt
