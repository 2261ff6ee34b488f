// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of analytic shapes.
#pragma once

#include <string>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

/// Errors of a shape's facets. Lengths in the shape's unit, angles in degrees.
struct FacetErrors {
    double distance = 0;      ///< largest, of the facets from the surface
    double face_normal = 0;   ///< largest, of the facets' normals
    double smooth_normal = 0; ///< largest, of interpolated vertex normals
};

struct Shape {
    Cloud mesh; ///< outward facets; vertices have the surface's exact normals, and are duplicated along edges
    FacetErrors errors;
};

/// name is one of
///   sphere  radius 1
///   torus   ring radius 1, tube radius 0.3, axis z
///   plate   1 x 1 x 0.01, closed
///   cube    edge 1
/// All centred at the origin. Throws Error (kBadUsage) for any other name.
Shape makeShape(const std::string& name);

/// Writes a binary PLY with normals. Throws Error (kCannotWrite) "PATH: reason".
void writeMesh(const std::string& path, const Cloud& mesh);

} // namespace pointrt::quality
