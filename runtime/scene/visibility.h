// SPDX-License-Identifier: Apache-2.0
// Visibility of a scan from a direction or a position, estimated from a sample of its splats.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/fit.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {

struct Visibility {
    double covered = 0;              ///< share of the picture that the scan covers
    double facing = 0;               ///< share of the picture that shows the front of a surface
    std::vector<std::uint32_t> seen; ///< visible splats of the sample
};

/// The visibility of sample in a parallel view along basis.forward. box: the part to view; its diagonal is the
/// picture's edge
Visibility visibleAlong(const SceneSample& sample, const SampleBox& box, const ViewBasis& basis);

/// The sum of the weights, one per splat, of the splats visible from eye in a square picture. fov_deg: field of view.
/// Discs occlude with their whole area, not only at their centres.
double visibleWeight(const SceneSample& sample, const std::vector<double>& weights, Vec3 eye, const ViewBasis& basis,
                     double fov_deg);

/// The splats visible from eye in a square picture.
SceneSample visibleFrom(const SceneSample& sample, Vec3 eye, const ViewBasis& basis, double fov_deg);

/// The surfaces around a place.
struct Surrounding {
    double covered = 0;  ///< share of all directions that meet a disc
    double level = 0;    ///< the same for directions within 16 degrees of level
    double above = 0;    ///< the same through the top face of a cube around the place, about 45 degrees from up
    double headroom = 0; ///< height of the ceiling above the eye; 0: no ceiling
    double distance = 0; ///< median distance over all directions that hit a disc
};

/// up: unit length
Surrounding surroundingOf(const SceneSample& sample, Vec3 eye, Vec3 up);

/// Whether a place is within walls and under a ceiling, where light from outside would be occluded.
bool isEnclosed(const Surrounding& surrounding);

} // namespace pointrt
