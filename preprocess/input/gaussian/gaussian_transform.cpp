// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/gaussian_transform.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// Transforms are written by hand or with few digits: deviations up to this are rounding, not skew.
constexpr double kSkewTolerance = 1e-3;

/// More directions than the 7 harmonics of degree 3, spread evenly on a spiral: the equations are far from singular
/// whatever the rotation.
constexpr int kDirections = 32;

Vec3d directionOf(int i) {
    const double z = 1 - (2 * i + 1.0) / kDirections, radius = std::sqrt(1 - z * z);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0)); // the golden angle
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The harmonics of one degree in all directions, after rotation; a row for each direction.
Eigen::MatrixXd evaluated(const Eigen::Matrix3d& rotation, int degree) {
    const int first = gaussianHarmonicCount(degree - 1), count = 2 * degree + 1;
    Eigen::MatrixXd values(kDirections, count);
    for (int i = 0; i < kDirections; ++i) {
        const auto all = gaussianHarmonics((rotation * directionOf(i)).normalized(), degree);
        for (int k = 0; k < count; ++k) values(i, k) = all[static_cast<std::size_t>(first + k)];
    }
    return values;
}

/// The three channels of the harmonics of one degree, a row for each harmonic.
void turnBand(const Eigen::MatrixXf& band, int degree, Gaussian& gaussian) {
    const auto first = static_cast<std::size_t>(gaussianHarmonicCount(degree - 1));
    Eigen::MatrixX3f factors(band.rows(), 3);
    for (Eigen::Index k = 0; k < band.rows(); ++k)
        factors.row(k) = gaussian.harmonics[first + static_cast<std::size_t>(k)].transpose();
    factors = (band * factors).eval();
    for (Eigen::Index k = 0; k < band.rows(); ++k)
        gaussian.harmonics[first + static_cast<std::size_t>(k)] = factors.row(k).transpose();
}

} // namespace

Eigen::MatrixXd harmonicRotation(const Eigen::Matrix3d& rotation, int degree) {
    return evaluated(rotation, degree).colPivHouseholderQr().solve(evaluated(Eigen::Matrix3d::Identity(), degree));
}

GaussianTransform::GaussianTransform(const InputFile& input, const Eigen::Matrix3d& linear, int degree)
    : is_identity_(linear.isIdentity(0)), degree_(degree) {
    if (is_identity_) return;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d scales = svd.singularValues();
    const double longest = scales.maxCoeff(), shortest = scales.minCoeff();
    if (!(longest > 0) || longest > (1 + kSkewTolerance) * shortest)
        refuse(input, "Gaussians can be moved, turned and scaled, but the transform scales them differently along "
                      "different axes");
    const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
    if (turn.determinant() < 0)
        refuse(input, "Gaussians can be moved, turned and scaled, but the transform mirrors them");
    scale_ = static_cast<float>(std::cbrt(linear.determinant()));
    rotation_ = Eigen::Quaterniond(turn).cast<float>();
    for (int band = 1; band <= degree; ++band)
        bands_[static_cast<std::size_t>(band - 1)] = harmonicRotation(turn, band).cast<float>();
}

void GaussianTransform::apply(Gaussian& gaussian) const {
    if (is_identity_) return;
    gaussian.deviations *= scale_;
    gaussian.rotation = rotation_ * gaussian.rotation;
    for (int degree = 1; degree <= degree_; ++degree)
        turnBand(bands_[static_cast<std::size_t>(degree - 1)], degree, gaussian);
}

} // namespace pointrt
