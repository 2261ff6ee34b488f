// SPDX-License-Identifier: GPL-3.0-or-later
// What is suspicious about the nearest neighbours of a point.
#pragma once

#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {

/// What is suspicious about a point's nearest neighbours.
enum class Suspicion : std::uint8_t {
    kUnsuspected,
    kMaybeLine, ///< they may be on a line
    kOnLine,    ///< they are on a line
    kInClump,   ///< most are in a clump, the others far away
    kAlone,     ///< they are in a clump or a thick line, however many they are
    kInNoise,   ///< they are in no plane, in a noisy cloud
    kOnOneSide  ///< they leave half of the plane empty
};

/// Moments of a list, in float: that is precise enough to distinguish lines from planes, and takes a third of the time
/// of momentsOf.
Moments quickMoments(const NeighborLists& lists, const PointSet& points, std::size_t point);

/// Whether points are on a line: for eigenvalues a >> b, c of their covariance, (b + c) a / (a + b + c)^2 is below
/// 0.139, so that (b + c) / a is below 1/5. Random neighbours on a surface form such a list in 1 of 250 cases.
bool isOnLine(const Moments& moments);

/// The largest number of nearest neighbours in a clump.
inline constexpr std::size_t kClumpSize = 6;

/// kUnsuspected to kInClump, by the nearest neighbours alone.
Suspicion suspicionOf(const NeighborLists& lists, const PointSet& points, std::size_t point);

/// Whether the misfit of a list's plane is above a limit. A line is in a plane.
bool isInNoPlane(const NeighborLists& lists, const PointSet& points, std::size_t point, float misfit);

/// Whether the neighbours of a point are on one side of it: their mean is as far off as in half a disc (0.42 radii),
/// but for chance. One in 50 lists of random neighbours all around is one-sided.
bool isOneSided(const NeighborLists& lists, const PointSet& points, std::size_t point);

} // namespace pointrt::surface
