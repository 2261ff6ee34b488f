// SPDX-License-Identifier: GPL-3.0-or-later
// A few splats that stand for all, and the directions that many of them face.
#pragma once

#include <vector>

#include "preprocess/cloud/splats.h"

namespace pointrt::upright {

struct SurfaceSample {
    std::vector<Vec3d> positions; ///< relative to the splats' origin
    std::vector<Vec3d> normals;   ///< unit length, their side is not asked for
    std::vector<double> areas;    ///< they add up to 1
    Vec3d extent = Vec3d::Zero(); ///< of the box without half a percent of the splats at each side
    Vec3d centroid = Vec3d::Zero();
};

/// Splats at even steps along the curve that they lie on.
SurfaceSample sampleSurface(const Splats& splats);

/// Shares of the area whose normals go along direction, and at right angles to it, to 10 degrees.
double shareAlong(const SurfaceSample& sample, const Vec3d& direction);
double shareAcross(const SurfaceSample& sample, const Vec3d& direction);

/// Unit normals of the planes that at least a twentieth of the area is parallel to, at most four; not those near axes.
std::vector<Vec3d> slantedPlanes(const SurfaceSample& sample);

/// The value below which this share of the values lies. values: at least one; they are put in another order.
double quantile(std::vector<double>& values, double share);

} // namespace pointrt::upright
