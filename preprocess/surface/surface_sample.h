// SPDX-License-Identifier: GPL-3.0-or-later
// A sample of splats, and the directions that many of them face.
#pragma once

#include <vector>

#include "preprocess/cloud/splats.h"

namespace pointrt::upright {

struct SurfaceSample {
    std::vector<Vec3d> positions; ///< relative to the splats' origin
    std::vector<Vec3d> normals;   ///< unit length, on either side; 0 for balls
    std::vector<double> areas;    ///< sum: 1
    Vec3d extent = Vec3d::Zero(); ///< of the box without 0.5% of the splats at each side
    Vec3d centroid = Vec3d::Zero();
};

/// Samples splats at even steps along their Morton curve.
SurfaceSample sampleSurface(const Splats& splats);

/// Shares of the area whose normals are parallel and perpendicular to direction, within 10 degrees.
double shareAlong(const SurfaceSample& sample, const Vec3d& direction);
double shareAcross(const SurfaceSample& sample, const Vec3d& direction);

/// Unit normals of at most four planes, not near axes, to which at least 5% of the area is parallel.
std::vector<Vec3d> slantedPlanes(const SurfaceSample& sample);

/// The value below which this share of the values is. Needs at least one value; reorders them.
double quantile(std::vector<double>& values, double share);

} // namespace pointrt::upright
