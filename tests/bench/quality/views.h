// SPDX-License-Identifier: Apache-2.0
// Parallel views of the truth and of the splats.
#pragma once

#include <string>

#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

/// Pixels per row and column, at least 1.
constexpr int kViewSize = 1024;
/// Half the edge of the picture. More than the truth's bounding sphere of radius 1, as discs may stick out of it.
constexpr float kViewHalf = 1.05f;
constexpr float kPixel = 2 * kViewHalf / kViewSize;

/// One pixel, for a ray through its centre. Infinite if nothing is hit.
struct PixelHits {
    float mesh_t, splat_t;
    float mesh_cos;       ///< between the ray and the face's normal, unsigned
    float splat_distance; ///< of the hit on the splat from the mesh
};

/// [kViewSize][kViewSize], rows along the view's second axis.
using View = std::vector<PixelHits>;

/// Unit vectors to the 6 faces and the 8 corners of a cube.
std::vector<Vec3f> viewDirections();

/// Casts the rays along direction, a unit vector.
View castView(const Tracing& truth, const Tracing& splats, const Vec3f& direction);

} // namespace pointrt::quality
