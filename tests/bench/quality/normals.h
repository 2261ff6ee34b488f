// SPDX-License-Identifier: Apache-2.0
// Splats against the faces they lie on.
#pragma once

#include "tests/bench/quality/statistics.h"
#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

/// Angles in degrees without sign; lengths in median radii.
struct SplatErrors {
    Summary face_normal;      ///< against the nearest face; of the faces that tie, the best one counts
    Summary smooth_normal;    ///< against the vertex normals interpolated there
    double wrong_share = 0;   ///< of splats more than kWrongDegrees off their face
    double flipped_share = 0; ///< of splats that face away from the outside of every face that ties
    Summary center_distance;  ///< of centres to the mesh
    Summary radius;
};

/// An error that shows: shading is off by a seventh even where light falls straight.
constexpr double kWrongDegrees = 30;

/// @param truth over mesh
SplatErrors compareSplats(const Mesh& mesh, const Tracing& truth, const Discs& discs);

} // namespace pointrt::quality
