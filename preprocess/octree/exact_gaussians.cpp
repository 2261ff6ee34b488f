// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/exact_gaussians.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

namespace {

/// 3,000 layers of opacity 1/255 reach 37 dB against the input with codes alone, and 45 dB with exact parameters beyond
/// these limits; 12,000 Gaussians of all sizes, seen from among them, 40 and 53 dB. 2.5 to 5% of the Gaussians of
/// captures are beyond the limits (tests/bench/NOTES.md).
constexpr double kMostOpacityError = 0.05, kMostAxisError = 0.003;

/// The columns are the axes as long as their deviations.
Eigen::Matrix3d axesOf(const float rotation[4], const float deviation[3]) {
    const Eigen::Quaterniond turn(rotation[0], rotation[1], rotation[2], rotation[3]);
    return turn.toRotationMatrix() * Vec3d(deviation[0], deviation[1], deviation[2]).asDiagonal();
}

bool counts(float opacity) { return opacity >= PRO_GAUSSIAN_OPACITY_MIN; }

bool opacityShows(float exact, float decoded) {
    if (counts(exact) != counts(decoded)) return true;
    return counts(exact) && std::abs(double{exact} - decoded) > kMostOpacityError * exact;
}

} // namespace

bool codesShow(const pro_exact_gaussian& exact, const pro_gaussian& decoded, double usual_deviation) {
    if (opacityShows(exact.opacity, decoded.opacity)) return true;
    const Eigen::Matrix3d moved = axesOf(exact.rotation, exact.deviation) - axesOf(decoded.rotation, decoded.deviation);
    return counts(exact.opacity) && moved.colwise().norm().maxCoeff() > kMostAxisError * usual_deviation;
}

pro_exact_gaussian exactOf(const pro_gaussian& gaussian, std::uint32_t index) {
    pro_exact_gaussian exact{};
    exact.index = index;
    const float* const given = gaussian.rotation;
    const Eigen::Vector4d rotation(given[0], given[1], given[2], given[3]);
    const double length = rotation.norm();
    const bool is_rotation = length > 0 && std::isfinite(length);
    for (int i = 0; i < 4; ++i)
        exact.rotation[i] = static_cast<float>(is_rotation ? rotation[i] / length : Eigen::Vector4d::UnitX()[i]);
    const float least = std::exp2(PRO_DEVIATION_LOG2_MIN), most = std::exp2(PRO_DEVIATION_LOG2_MAX);
    for (int axis = 0; axis < 3; ++axis) // in this order, so that NaN becomes the smallest
        exact.deviation[axis] = std::min(std::max(least, gaussian.deviation[axis]), most);
    exact.opacity = std::min(std::max(0.0f, gaussian.opacity), 1.0f);
    return exact;
}

} // namespace pointrt
