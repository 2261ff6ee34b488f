// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/beam_footprint.h"

#include <cmath>
#include <numbers>

#include "runtime/studies/study_values.h"

namespace pointrt {
namespace {

/// The radius, relative to the cone's, within which this share of the cone's power lies. A Gaussian beam has 1 - exp(-2
/// r^2) of its power within r.
double circleOf(double share) { return std::sqrt(-0.5 * std::log1p(share * std::expm1(-2.0))); }

/// A unit vector perpendicular to axis.
Vec3 beside(Vec3 axis) {
    const Vec3 other = std::abs(axis.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}; // at least 30 degrees from axis
    return normalize(cross(axis, other));
}

} // namespace

BeamFootprint::BeamFootprint(double divergence_mrad, std::size_t count) : tangents_(count) {
    const double half_angle = divergence_mrad / 2000;
    for (std::size_t i = 0; i < count && count > 1; ++i)
        tangents_[i] = std::tan(half_angle * circleOf((static_cast<double>(i) + 0.5) / static_cast<double>(count)));
}

BeamFootprint::Around::Around(Vec3 along, double start)
    : axis(along), u(beside(along)), v(cross(along, u)), angle(2 * std::numbers::pi * start) {}

Vec3 BeamFootprint::ray(const Around& around, std::size_t i) const {
    if (tangents_[i] == 0) return around.axis;
    const double angle = around.angle + kGoldenAngle * static_cast<double>(i);
    return normalize(around.axis + tangents_[i] * (std::cos(angle) * around.u + std::sin(angle) * around.v));
}

} // namespace pointrt
