// SPDX-License-Identifier: GPL-3.0-or-later
// Planes through weighted neighbourhoods.
#pragma once

#include <array>
#include <span>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Mean and covariance of a neighbourhood, relative to its point: small numbers, for which float is enough.
struct Moments {
    Vec3f mean = Vec3f::Zero();
    std::array<float, 6> covariance{}; ///< xx xy xz yy yz zz
};

/// A plane's normal (unit length, on either side) and how badly the neighbourhood fits it.
struct PlaneFit {
    Vec3f normal = Vec3f::UnitZ();
    /// Smallest over middle eigenvalue of the covariance: 0 in a plane, 1 for isotropic scatter; infinite if the
    /// neighbours lie on a line, as any plane through it fits.
    float misfit = 0;
};

/// Least-squares plane of a covariance, by pcl::eigen33 in double. pcl::solvePlaneParameters would not do: it works in
/// float, where the smallest eigenvalue of a smooth surface is off by 0.1%, gives NaN for points on a line, and does
/// not return the middle eigenvalue.
PlaneFit fitPlane(const Moments& moments);

/// fitPlane(moments).misfit, without the time that the normal takes: more than half.
float misfitOf(const Moments& moments);

/// Moments of a point and its neighbours with equal weights, by pcl::computeMeanAndCovarianceMatrix in double.
Moments momentsOf(const PointSet& points, std::span<const std::uint32_t> neighbors, std::size_t point);

/// Moments averaged over a point and its neighbours: those of a wider, bell-shaped neighbourhood.
Moments spreadMoments(const std::vector<Moments>& moments, const PointSet& points, const NeighborLists& lists,
                      std::size_t point);

/// Root mean square height of a point's neighbours over its tangent plane.
float heightOver(const PointSet& points, const NeighborLists& lists, std::size_t point);

} // namespace pointrt::surface
