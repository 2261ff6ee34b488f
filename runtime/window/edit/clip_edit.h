// SPDX-License-Identifier: Apache-2.0
// Clips as the panel edits them.
#pragma once

#include <optional>

#include "runtime/scene/clip.h"

namespace pointrt {

/// A box around the scan, which cuts nothing yet. low, high: bounds of the scan, world units.
ClipDescription newClipBox(Vec3 low, Vec3 high);

/// A place on a surface, and its normal, of unit length.
struct ClipSurface {
    Vec3 position, normal;
};
/// A plane through a picked point, perpendicular to the axis nearest to the surface normal, that cuts away the viewer's
/// side. Without a pick, a level plane through the middle of the scan that keeps the part below. forward: of the
/// camera; up: of the scene; both of unit length
ClipDescription newClipPlane(const std::optional<ClipSurface>& picked, Vec3 forward, Vec3 middle, Vec3 up);

/// Moves one side of a box along the box's own axis; the other sides stay in place, even if the box is rotated. The box
/// remains at least `least` thick, which is above 0.
/// @param axis 0, 1, 2: x, y, z
void setBoxSide(ClipBox& box, std::size_t axis, bool is_high, double value, double least);

/// The coordinate of v along an axis.
double& coordinate(Vec3& v, std::size_t axis);

} // namespace pointrt
