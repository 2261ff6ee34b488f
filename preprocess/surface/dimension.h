// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a point lies on a surface, or among points scattered in space.
#pragma once

#include <vector>

#include "preprocess/neighbors/neighbors.h"

namespace pointrt::surface {

/// How far the surroundings of each point are a surface: 1 a smooth one, an edge or a corner, however noisy, as long as
/// the neighbourhood shows it; 0 points scattered in space, as leaves and strays are; in between neither is clear.
/// Empty where the cloud is one of surfaces, or has fewer than 1000 points. The dimension of a neighbourhood by the
/// eigenvalues of its covariance, at the scale where it is most a plane (Pauly et al., Efficient simplification of
/// point-sampled surfaces, 2002; Demantke et al., Dimensionality based scale selection in 3D lidar point clouds, 2011).
/// Points need normals.
std::vector<float> sheetShares(const Points& points, const NeighborLists& lists, const StageShare& share);

} // namespace pointrt::surface
