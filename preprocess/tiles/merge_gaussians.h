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
    double opacity = 0; ///< of its peak
};

/// The mean area of an ellipsoid's shadow over all directions, for the ellipsoid of one deviation: a quarter of its
/// surface (Cauchy), which is that of Thomsen's formula, within 1.1%.
double meanShadow(const Eigen::Matrix3d& covariance);

/// The share of each Gaussian in a group: by what it hides on average, its opacity times its shadow. They add up to 1.
std::vector<double> mergeShares(std::span<const GaussianMoments> members);

/// Mean and covariance of the group, by shares. It hides as much as all of its members do, side by side or one behind
/// the other, whichever is less.
GaussianMoments mergeMoments(std::span<const GaussianMoments> members, std::span<const double> shares);

/// As mergeSplats, of children with the attributes of Gaussians (gaussian_tiles.h). Groups are those that their discs
/// have there; giants, which would swallow what lies before them, stay alone.
TileSplats mergeGaussians(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                          double edge, std::uint64_t tile_splats);

} // namespace pointrt
