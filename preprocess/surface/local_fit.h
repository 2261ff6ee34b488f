// SPDX-License-Identifier: GPL-3.0-or-later
// Algebraic spheres through points with normals.
#pragma once

#include "preprocess/surface/surroundings.h"

namespace pointrt::surface {

/// The zeros of constant + linear . q + square q . q, scaled so that its values are distances near them.
struct AlgebraicSphere {
    float constant = 0;
    Vec3f linear = Vec3f::Zero();
    float square = 0;

    /// A plane through the origin.
    static AlgebraicSphere plane(const Vec3f& normal) { return {0, normal, 0}; }
};

/// Of a group of neighbours from a sphere, with signs.
inline Lanes distancesFrom(const Surroundings& around, std::size_t group, const AlgebraicSphere& sphere) {
    const auto of = [&](const std::vector<float>& values) { return Surroundings::lanes(values, group); };
    const Lanes x = of(around.x), y = of(around.y), z = of(around.z);
    return sphere.constant + sphere.linear.x() * x + sphere.linear.y() * y + sphere.linear.z() * z +
           sphere.square * (x * x + y * y + z * z);
}

/// Weights of a group of neighbours: at distance r from a sphere (1 + r^2 inverse)^-2 times that in the surroundings,
/// so that what is on another layer, or off, has little say. inverse is that of a scale squared.
inline Lanes robustWeights(const Surroundings& around, std::size_t group, const AlgebraicSphere& from, float inverse) {
    const Lanes r = distancesFrom(around, group, from);
    const Lanes outlying = 1 + r * r * inverse;
    return Surroundings::lanes(around.weight, group) / (outlying * outlying);
}

/// The sphere that fits the neighbours' places and normals best (G. Guennebaud and M. Gross, Algebraic Point Set
/// Surfaces, SIGGRAPH 2007, equation 10, beta 1), with robustWeights of this scale.
AlgebraicSphere fitSphere(const Surroundings& around, const AlgebraicSphere& from, float scale);

/// Share of the neighbours within a distance of a sphere, all of one weight.
float supportOf(const Surroundings& around, const AlgebraicSphere& sphere, float distance);

/// Where the origin goes on the sphere: the nearest place.
Vec3f projectOrigin(const AlgebraicSphere& sphere);

/// Direction of the sphere's gradient there; the same as that at the origin.
Vec3f normalAtOrigin(const AlgebraicSphere& sphere);

} // namespace pointrt::surface
