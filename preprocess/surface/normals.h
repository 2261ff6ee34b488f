// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates normals by plane fits, on either side of the surface.
#pragma once

#include "preprocess/surface/point_graph.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt::surface {

/// Sets points.normals, and points.side_known to 1 for points whose normal was given and is kept. Throws Error
/// (kBadInput) if a normal is missing for kKeep.
void fillNormals(PointGraph& graph, NormalSource source, const StageProgress& progress);

} // namespace pointrt::surface
