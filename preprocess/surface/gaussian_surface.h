// SPDX-License-Identifier: GPL-3.0-or-later
// The opaque part of a cloud of Gaussians as a surface, for measures that need one.
#pragma once

#include "preprocess/cloud/gaussians.h"
#include "preprocess/cloud/splats.h"

namespace pointrt {

/// Discs of equal size, spread evenly over the area of the Gaussians that are neither faint nor as large as a sky.
/// Their normals are the shortest axes, or 0 where a Gaussian is not flat. The result does not depend on the number of
/// threads. Empty if nothing is opaque.
Splats surfaceOfGaussians(const Cloud& cloud, const GaussianColumns& gaussians);

} // namespace pointrt
