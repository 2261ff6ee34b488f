// SPDX-License-Identifier: GPL-3.0-or-later
// Fits algebraic spheres to points with normals.
#pragma once

#include "preprocess/surface/neighborhood.h"

namespace pointrt::surface {

/// The zero set of f(q) = constant + linear . q + square q . q, scaled so that f is about the signed distance near it.
struct AlgebraicSphere {
    float constant = 0;
    Vec3f linear = Vec3f::Zero();
    float square = 0;

    /// A plane through the origin.
    static AlgebraicSphere plane(const Vec3f& normal) { return {0, normal, 0}; }
};

/// Signed distances of a group of neighbours from a sphere.
inline Lanes distancesFrom(const Neighborhood& around, std::size_t group, const AlgebraicSphere& sphere) {
    const auto of = [&](const std::vector<float>& values) { return Neighborhood::lanes(values, group); };
    const Lanes x = of(around.x), y = of(around.y), z = of(around.z);
    return sphere.constant + sphere.linear.x() * x + sphere.linear.y() * y + sphere.linear.z() * z +
           sphere.square * (x * x + y * y + z * z);
}

/// Weights of a group of neighbours, times (1 + r^2 / scale^2)^-2 at distance r from a sphere: points on another layer
/// or off the surface hardly count. inverse is 1 / scale^2.
inline Lanes robustWeights(const Neighborhood& around, std::size_t group, const AlgebraicSphere& from, float inverse) {
    const Lanes r = distancesFrom(around, group, from);
    const Lanes outlying = 1 + r * r * inverse;
    return Neighborhood::lanes(around.weight, group) / (outlying * outlying);
}

/// The sphere that best fits the neighbours' positions and normals (G. Guennebaud and M. Gross, Algebraic Point Set
/// Surfaces, SIGGRAPH 2007, equation 10, beta 1), with robustWeights of this scale.
AlgebraicSphere fitSphere(const Neighborhood& around, const AlgebraicSphere& from, float scale);

/// Share of the neighbours within a distance of a sphere, unweighted.
float supportOf(const Neighborhood& around, const AlgebraicSphere& sphere, float distance);

/// The point of the sphere nearest to the origin.
Vec3f projectOrigin(const AlgebraicSphere& sphere);

/// The sphere's unit normal at that point: the gradient's direction, which is the same at the origin.
Vec3f normalAtOrigin(const AlgebraicSphere& sphere);

} // namespace pointrt::surface
