// SPDX-License-Identifier: GPL-3.0-or-later
// Rotates and scales Gaussians, with their view-dependent colours.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "preprocess/input/gaussian/gaussians.h"

namespace pointrt {

/// The linear part of a transform that rotates and scales equally in all directions.
class GaussianTransform {
public:
    /// Throws Error, which names the input, if the transform mirrors, skews or is not invertible.
    GaussianTransform(const InputFile& input, const Eigen::Matrix3d& linear, int degree);

    /// Transforms all but the position.
    void apply(Gaussian& gaussian) const;

private:
    bool is_identity_;
    int degree_;
    float scale_ = 1;
    Eigen::Quaternionf rotation_ = Eigen::Quaternionf::Identity();
    /// [degree - 1]: matrices that turn harmonic coefficients into those of the rotated Gaussian.
    std::array<Eigen::MatrixXf, 3> bands_;
};

/// The matrix that turns factors of the harmonics of one degree: a colour that was seen along d is then seen along
/// rotation * d. degree: 1 to 3
Eigen::MatrixXd harmonicRotation(const Eigen::Matrix3d& rotation, int degree);

} // namespace pointrt
