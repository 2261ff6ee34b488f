// SPDX-License-Identifier: GPL-3.0-or-later
// Turns and scales Gaussians, with their view-dependent colours.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "preprocess/input/gaussian/gaussians.h"

namespace pointrt {

/// The linear part of a transform that turns and scales alike in all directions.
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
    std::array<Eigen::MatrixXf, 3> bands_; ///< by degree minus 1: factors of the turned harmonics from those before
};

/// The matrix that turns factors of the harmonics of one degree: a colour that was seen along d is then seen along
/// rotation * d. degree: 1 to 3
Eigen::MatrixXd harmonicRotation(const Eigen::Matrix3d& rotation, int degree);

} // namespace pointrt
