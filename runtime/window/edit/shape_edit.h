// SPDX-License-Identifier: Apache-2.0
// Inserting shapes into a scene.
#pragma once

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Where to put a shape: upright on a surface, at a point with this outward normal.
struct ShapePlace {
    Vec3 point, normal, up; ///< normal, up: unit length
    Vec3 towards_eye;       ///< any length, not along up: panes face it
    double size = 1;        ///< diameter, or the longest edge; above 0
};

/// The kinds that can be inserted. Planes cannot: they are infinite, and serve as floors.
inline constexpr ShapeKind kInsertedShapes[] = {ShapeKind::kSphere, ShapeKind::kBox, ShapeKind::kQuad,
                                                ShapeKind::kDisc};

/// Adds a matte shape that rests on the surface, with its own material. mayAddShape (layers.h) must be true.
void addShape(SceneDescription& scene, ShapeKind kind, const ShapePlace& place);

/// Moves a shape so that it rests on a surface at a point with this outward normal, of unit length.
void restOn(ShapeDescription& shape, Vec3 point, Vec3 normal);

/// How far a shape reaches from its centre along a direction of unit length; 0 for planes.
double reachAlong(const ShapeDescription& shape, Vec3 direction);

} // namespace pointrt
