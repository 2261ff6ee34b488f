// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps lines of sight free: no disc covers what a scanner saw through it.
#pragma once

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// Shrinks discs (points.radii) to where a line of sight to a measured point passes through them, if that point is
/// clearly behind the disc: off its plane by more than the noise, and at an angle that neither the surface's curvature
/// nor the error of the normal explains. Keeps a disc at least half the distance to its point's second neighbour.
/// Sensors of other scans count from their third sightline on and need more distance behind the disc, as registration
/// errs. Does not use a sensor that contradicts itself, as in files that name one for a cloud merged from many scans,
/// nor one so far away that it represents a direction (setSensorAlongZ). Discs of scattered points (planarity) stay.
/// @param measured number of points measured by a sensor; those after it are interpolated (fillBetweenLines)
/// @return the number of discs that shrank; 0 if no sensor is known
/// The result does not depend on the number of threads.
std::size_t clearSightlines(PointGraph& graph, std::size_t measured, const StageShare& share);

} // namespace pointrt::surface
