// SPDX-License-Identifier: GPL-3.0-or-later
// Fits quadric height fields over a tangent plane.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "preprocess/surface/algebraic_sphere.h"

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
    float variance = 0; ///< weighted mean square of the residuals
};

/// Least squares over neighbours with robustWeights of this scale; nullopt if they do not determine all terms.
std::optional<QuadricFit> fitQuadric(const Neighborhood& around, const TangentFrame& frame, const AlgebraicSphere& from,
                                     float scale);

/// Unit normal of the height field at the frame's origin, on the frame's side.
Vec3f normalOf(const QuadricTerms& terms, const TangentFrame& frame);

/// Variance of the noise: sum of squared residuals of a quadric through the point and these neighbours, unweighted,
/// over the degrees of freedom. 0 if there are too few neighbours.
double residualVariance(const PointSet& points, std::span<const std::uint32_t> neighbors, std::size_t point);

} // namespace pointrt::surface
