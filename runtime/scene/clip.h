// SPDX-License-Identifier: Apache-2.0
// Clips cut scans: they keep the part of each scan that lies inside all clips, an intersection of half-spaces. Rays
// pass through the rest. Shapes, lights, rooms and floors are not cut.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "runtime/scene/layer.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// Keeps the inside of a box: from low to high in world units, then rotated about its centre.
struct ClipBox {
    Vec3 low, high;                                                            ///< low is below high on each axis
    std::array<Vec3, 3> rotation{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< orthonormal rows, world from box
    bool operator==(const ClipBox&) const = default;
};

/// Keeps the side that the normal points to.
struct ClipPlane {
    Vec3 point, normal{0, 0, 1}; ///< world units; unit length
    bool operator==(const ClipPlane&) const = default;
};

struct ClipDescription {
    std::variant<ClipBox, ClipPlane> form;
    bool enabled = true; ///< false: the clip cuts nothing
    Layer layer{};
    bool operator==(const ClipDescription&) const = default;
};

/// Keeps the points p with dot(normal, p - point) >= 0. normal: unit length.
struct HalfSpace {
    Vec3 point, normal;
};

/// An axis-aligned box from MINX, MINY, MINZ, MAXX, MAXY and MAXZ.
ClipDescription clipBox(const std::array<double, 6>& ends);

/// The half-spaces whose intersection the enabled clips keep: six for a box, one for a plane.
std::vector<HalfSpace> keptHalfSpaces(std::span<const ClipDescription> clips);
/// The number of half-spaces of all clips, enabled or not. A scene has at most MAX_CLIP_PLANES
/// (shaders/shared/scene_layout.h).
std::size_t countHalfSpaces(std::span<const ClipDescription> clips);

/// Throws Error kBadUsage if clips have more half-spaces than a scene may have.
void requireFewHalfSpaces(std::span<const ClipDescription> clips);

/// A half-space that contains no point of a scene.
HalfSpace nothingKept();

/// Whether a point is inside all half-spaces.
bool isKept(std::span<const HalfSpace> kept, Vec3 point);

} // namespace pointrt
