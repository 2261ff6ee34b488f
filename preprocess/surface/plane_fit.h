// SPDX-License-Identifier: GPL-3.0-or-later
// Planes through weighted neighbourhoods.
#pragma once

#include <array>
#include <span>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Mean and covariance of a neighbourhood, seen from its point: small numbers, so that float is enough.
struct Moments {
    Vec3f mean = Vec3f::Zero();
    std::array<float, 6> covariance{}; ///< xx xy xz yy yz zz
};

/// A plane's normal (unit length, on either side) and how badly the neighbourhood fits it.
struct PlaneFit {
    Vec3f normal = Vec3f::UnitZ();
    /// Smallest over middle eigenvalue of the covariance: 0 in a plane, 1 in a cloud without one; infinite
    /// where the neighbours lie on a line and any plane through it fits.
    float misfit = 0;
};

/// Least-squares plane of a covariance, by PCL's eigen33.
PlaneFit fitPlane(const Moments& moments);

/// Moments of a point and its neighbours, all of the same weight.
Moments momentsOf(const Points& points, std::span<const std::uint32_t> neighbors, std::size_t point);

/// The average over a point and its neighbours of the moments of each: those of the wider, bell-shaped neighbourhood
/// that the neighbours reach.
Moments spreadMoments(const std::vector<Moments>& moments, const Points& points, const NeighborLists& lists,
                      std::size_t point);

/// Root mean square height of a point's neighbours over its tangent plane.
float heightOver(const Points& points, const NeighborLists& lists, std::size_t point);

} // namespace pointrt::surface
