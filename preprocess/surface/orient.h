// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of the surface is out?
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt::surface {

/// Turns points.normals by mode, in this order:
///   1. kAuto: given normals keep their side; the others face their sensor, where one is known, or up, where none is
///      and all was seen from there. kUp: all face up, +Z where that is not known.
///   2. kAuto, kUp, kMst: what is left follows its neighbours along a minimum spanning tree (Hoppe et al. 1992). So do
///      normals that see their sensor, or the sky, at a grazing angle.
///   3. A component of the neighbour graph that holds no known side is turned as a whole. Sheets that lie a few
///   spacings
///      apart, without a rim that joins them, are one: back to back. Outwards, seen from its
///      centroid, or upwards, towards +Z, whichever its normals agree on more: the first for objects, the second for
///      ground. Rooms seen from within come out with their normals in the walls, unless the sensor is known.
/// given flags the points whose normals came with the cloud. Returns whether the normals are oriented: with kNone
/// only when all were given. Throws Error (kBadInput) when kSensor lacks a sensor.
bool orientNormals(Points& points, const NeighborLists& lists, const NearestSearch& search,
                   const std::vector<std::uint8_t>& given, OrientMode mode, std::size_t& flipped_count,
                   const StageProgress& progress);

} // namespace pointrt::surface
