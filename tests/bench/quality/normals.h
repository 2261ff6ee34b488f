// SPDX-License-Identifier: Apache-2.0
// Compares splats with the faces they are on.
#pragma once

#include "tests/bench/quality/statistics.h"
#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

/// Angles in degrees, unsigned; lengths in median radii.
struct SplatErrors {
    Summary face_normal;      ///< to the nearest face; the best of several that tie
    Summary smooth_normal;    ///< to the interpolated vertex normals
    double wrong_share = 0;   ///< of splats more than kWrongDegrees off their face
    double flipped_share = 0; ///< of splats that face inwards from every face that ties
    Summary center_distance;  ///< of centres from the mesh
    Summary radius;
};

/// A visible error: shading is off by a seventh even at normal incidence.
constexpr double kWrongDegrees = 30;

/// @param truth a tracer over mesh
SplatErrors compareSplats(const Mesh& mesh, const Tracing& truth, const Discs& discs);

} // namespace pointrt::quality
