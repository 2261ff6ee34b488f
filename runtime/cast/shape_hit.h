// SPDX-License-Identifier: Apache-2.0
// Intersects rays with the shapes of scene files, in doubles; shaders/trace/shapes.glsl does so in floats.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/scene/scene_description.h"

namespace pointrt {

struct ShapeHit {
    double t = 0; ///< in lengths of the direction
    std::uint32_t shape = 0;
};

/// The nearest hit with t_min <= t < t_max, from outside or inside. Ignores backdrops and shapes hidden from cameras,
/// as first hits of pictures do.
std::optional<ShapeHit> firstShape(std::span<const ShapeDescription> shapes, Vec3 origin, Vec3 direction, double t_min,
                                   double t_max);

/// The unit normal at a point of the shape; outward for boxes and spheres.
Vec3 shapeNormal(const ShapeDescription& shape, Vec3 point);

} // namespace pointrt
