// SPDX-License-Identifier: Apache-2.0
// How much of a scan is seen from where, as far as a few splats tell.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/fit.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {

struct Sight {
    double covered = 0; ///< of the picture: area at the scale of the whole scan, 1 for its longest edge squared
    double facing = 0;  ///< ... whose front is seen
    std::vector<std::uint32_t> seen; ///< splats of the sample that nothing hides
};

/// A parallel look at all of sample along basis. box: what of it is looked at
Sight lookAlong(const SceneSample& sample, const SampleBox& box, const ViewBasis& basis);

/// Sum of the weights, one for each splat, of what an eye within the sample sees in a picture of this field of view,
/// degrees, as wide as high. Discs hide what is behind all of them, not behind their middles only.
double seenFrom(const SceneSample& sample, const std::vector<double>& weights, Vec3 eye, const ViewBasis& basis,
                double fov_deg);

} // namespace pointrt
