// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians of a coarser level by moment matching: a group becomes the Gaussian of its mean and covariance.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "preprocess/tiles/merge_tile.h"

namespace pointrt {

/// A Gaussian in one unit of length.
struct GaussianMoments {
    Vec3d mean = Vec3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double opacity = 0; ///< opacity at the peak
};

/// Area of an ellipsoid's shadow averaged over all directions, for the ellipsoid of one standard deviation: a quarter
/// of its surface (Cauchy), which Thomsen's formula gives within 1.1%.
double meanShadow(const Eigen::Matrix3d& covariance);

/// The weight of each Gaussian in a group: proportional to what it hides on average, its opacity times its shadow. The
/// weights add up to 1.
std::vector<double> mergeShares(std::span<const GaussianMoments> members);

/// Weighted mean and covariance of the group. Its opacity makes it hide as much as all of its members, either side by
/// side or one behind another, whichever is less.
GaussianMoments mergeMoments(std::span<const GaussianMoments> members, std::span<const double> shares);

/// Does what mergeSplats does, for children with the attributes of Gaussians (gaussian_tiles.h). Groups members as
/// mergeSplats would group their discs; giants, which would swallow what lies in front of them, are not merged.
TileSplats mergeGaussians(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                          double edge, std::uint64_t tile_splats);

} // namespace pointrt
