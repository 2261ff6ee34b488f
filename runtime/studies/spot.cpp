// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/spot.h"

#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// Between neighbours of Vogel's spiral ("A better way to construct the sunflower head", 1979): they spread evenly.
constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

/// Of the cone's half angle, the circle that holds this share of the power in the cone: a Gaussian beam has
/// 1 - exp(-2 r^2) of its power within r.
double circleOf(double share) { return std::sqrt(-0.5 * std::log1p(share * std::expm1(-2.0))); }

/// At a right angle to axis, unit length.
Vec3 beside(Vec3 axis) {
    const Vec3 other = std::abs(axis.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}; // at 30 degrees from it, or more
    return normalize(cross(axis, other));
}

} // namespace

LidarSpot::LidarSpot(double divergence_mrad, std::size_t count) : aside_(count) {
    const double half_angle = divergence_mrad / 2000;
    for (std::size_t i = 0; i < count && count > 1; ++i)
        aside_[i] = std::tan(half_angle * circleOf((static_cast<double>(i) + 0.5) / static_cast<double>(count)));
}

LidarSpot::Around::Around(Vec3 along, double turn)
    : axis(along), u(beside(along)), v(cross(along, u)), angle(2 * std::numbers::pi * turn) {}

Vec3 LidarSpot::ray(const Around& around, std::size_t i) const {
    if (aside_[i] == 0) return around.axis;
    const double angle = around.angle + kGoldenAngle * static_cast<double>(i);
    return normalize(around.axis + aside_[i] * (std::cos(angle) * around.u + std::sin(angle) * around.v));
}

} // namespace pointrt
