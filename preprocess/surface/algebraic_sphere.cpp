// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/algebraic_sphere.h"

#include <cmath>

namespace pointrt::surface {
namespace {

/// Weighted sums over the neighbours.
struct SphereSums {
    float weight = 0, place_square = 0, place_normal = 0;
    Vec3f place = Vec3f::Zero(), normal = Vec3f::Zero();
};

SphereSums sumUp(const Neighborhood& around, const AlgebraicSphere& from, float scale) {
    Lanes weight = Lanes::Zero(), square = weight, along = weight;
    Lanes px = weight, py = weight, pz = weight, nx = weight, ny = weight, nz = weight;
    const float inverse = 1 / (scale * scale);
    for (std::size_t group = 0; group < around.laneGroups(); ++group) {
        const auto of = [&](const std::vector<float>& values) { return Neighborhood::lanes(values, group); };
        const Lanes x = of(around.x), y = of(around.y), z = of(around.z);
        const Lanes q = x * x + y * y + z * z;
        const Lanes w = robustWeights(around, group, from, inverse);
        const Lanes mx = w * of(around.nx), my = w * of(around.ny), mz = w * of(around.nz);
        weight += w, square += w * q, along += mx * x + my * y + mz * z;
        px += w * x, py += w * y, pz += w * z;
        nx += mx, ny += my, nz += mz;
    }
    return {weight.sum(), square.sum(), along.sum(), {px.sum(), py.sum(), pz.sum()}, {nx.sum(), ny.sum(), nz.sum()}};
}

/// Pratt's normalisation: the gradient has length 1 on the zero set.
AlgebraicSphere normalized(AlgebraicSphere sphere) {
    const float squared = sphere.linear.squaredNorm() - 4 * sphere.constant * sphere.square;
    const float inverse = squared > 0 ? 1 / std::sqrt(squared) : 0;
    sphere.constant *= inverse, sphere.linear *= inverse, sphere.square *= inverse;
    return sphere;
}

} // namespace

AlgebraicSphere fitSphere(const Neighborhood& around, const AlgebraicSphere& from, float scale) {
    const SphereSums sums = sumUp(around, from, scale);
    if (!(sums.weight > 0)) return from;
    const float inverse = 1 / sums.weight;
    const float spread = sums.place_square - sums.place.squaredNorm() * inverse;
    const float turning = sums.place_normal - sums.place.dot(sums.normal) * inverse;
    AlgebraicSphere sphere;
    sphere.square = spread > 0 ? turning / spread / 2 : 0;
    sphere.linear = (sums.normal - 2 * sphere.square * sums.place) * inverse;
    sphere.constant = -(sphere.linear.dot(sums.place) + sphere.square * sums.place_square) * inverse;
    return normalized(sphere);
}

float supportOf(const Neighborhood& around, const AlgebraicSphere& sphere, float distance) {
    std::uint32_t near = 0;
    for (std::size_t group = 0; group < around.laneGroups(); ++group) {
        const Lanes off = distancesFrom(around, group, sphere).abs();
        const float* weights = &around.weight[group * kLaneCount];
        for (std::size_t lane = 0; lane < kLaneCount; ++lane)
            near += std::uint32_t(off[Eigen::Index(lane)] < distance) & std::uint32_t(weights[lane] > 0);
    }
    return float(near) / float(around.count);
}

Vec3f projectOrigin(const AlgebraicSphere& sphere) {
    const float slope = sphere.linear.norm();
    const float root = slope * slope - 4 * sphere.constant * sphere.square;
    if (!(slope > 0) || !(root >= 0)) return Vec3f::Zero();
    return sphere.linear * (-2 * sphere.constant / ((slope + std::sqrt(root)) * slope));
}

Vec3f normalAtOrigin(const AlgebraicSphere& sphere) { return sphere.linear.normalized(); }

} // namespace pointrt::surface
