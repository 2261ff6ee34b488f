// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of shapes whose surface is known by formula.
#pragma once

#include <string>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

/// What the facets of a shape get wrong. Lengths in the shape's unit, angles in degrees.
struct FacetErrors {
    double distance = 0;      ///< of the facets to the surface, largest
    double face_normal = 0;   ///< of the facets' own normals, largest
    double smooth_normal = 0; ///< of the vertex normals interpolated over the facets, largest
};

struct Shape {
    Cloud mesh; ///< outward facets; a vertex has the surface's exact normal, and is doubled where faces meet in an edge
    FacetErrors errors;
};

/// name is one of
///   sphere  radius 1
///   torus   ring radius 1, tube radius 0.3, axis z
///   plate   1 x 1 x 0.01, closed
///   cube    edge 1
/// All about the origin. Throws Error (kBadUsage) when it is none of them.
Shape makeShape(const std::string& name);

/// Writes a binary PLY with normals. Throws Error (kCannotWrite) "PATH: reason".
void writeMesh(const std::string& path, const Cloud& mesh);

} // namespace pointrt::quality
