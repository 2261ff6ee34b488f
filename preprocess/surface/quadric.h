// SPDX-License-Identifier: GPL-3.0-or-later
// Height fields of second order over a tangent plane.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "preprocess/surface/local_fit.h"

namespace pointrt::surface {

/// height = c0 + c1 u + c2 v + c3 u^2 + c4 u v + c5 v^2 over a plane with axes u and v.
using QuadricTerms = std::array<float, 6>;

/// Axes of a tangent plane.
struct TangentFrame {
    Vec3f u, v, normal;
    explicit TangentFrame(const Vec3f& unit_normal)
        : u(unit_normal.unitOrthogonal()), v(unit_normal.cross(u)), normal(unit_normal) {}
};

struct QuadricFit {
    QuadricTerms terms;
    float variance = 0; ///< weighted mean square of what it leaves unexplained
};

/// Least squares over neighbours with robustWeights of this scale; nothing where they
/// do not determine all terms.
std::optional<QuadricFit> fitQuadric(const Surroundings& around, const TangentFrame& frame, const AlgebraicSphere& from,
                                     float scale);

/// Of the height field over the frame's origin, unit length, on the frame's side.
Vec3f normalOf(const QuadricTerms& terms, const TangentFrame& frame);

/// Mean square of what a quadric through these neighbours, all of one weight, and the point itself leaves unexplained,
/// over its degrees of freedom: the variance of what is noise; 0 where there are too few neighbours to tell.
double residualVariance(const Points& points, std::span<const std::uint32_t> neighbors, std::size_t point);

} // namespace pointrt::surface
