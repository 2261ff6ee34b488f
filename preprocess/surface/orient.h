// SPDX-License-Identifier: GPL-3.0-or-later
// Orients normals: turns them to the outside of the surface.
#pragma once

#include "preprocess/surface/point_graph.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt::surface {

struct OrientReport {
    bool oriented = true; ///< all normals have a known side
    std::size_t flipped = 0;
};

/// Turns points.normals by mode, in this order:
///   1. kAuto: normals with a known side (points.side_known) keep it; the others face their sensor or, if no sensor is
///      known and everything was seen from above, up. kUp: all face up, +Z if up is unknown.
///   2. kAuto, kUp, kMst: the others follow their neighbours along a minimum spanning tree (Hoppe et al. 1992), also
///      those that see their sensor or the sky at a grazing angle.
///   3. Connected components without a known side are turned as a whole: outwards from their centroid, or up,
///      whichever their normals agree on more. The first suits objects, the second ground. Sheets back to back, a few
///      spacings apart, count as one component, even if no edge joins them. Rooms scanned from within, without a known
///      sensor, get normals that point into the walls.
/// With kNone, nothing is turned, and normals count as oriented only if all have a known side. Throws Error (kBadInput)
/// if a sensor is missing for kSensor.
OrientReport orientNormals(PointGraph& graph, OrientMode mode, const StageProgress& progress);

} // namespace pointrt::surface
