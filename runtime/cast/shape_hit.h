// SPDX-License-Identifier: Apache-2.0
// Rays and the surfaces without splats of scene files, in doubles; shaders/trace/shapes.glsl has the same in floats.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/scene/scene_description.h"

namespace pointrt {

struct ShapeHit {
    double t = 0; ///< lengths of the direction
    std::uint32_t shape = 0;
};

/// The first of the shapes that the ray meets from t_min on and before t_max, from outside or inside; those that
/// cameras do not see and backdrops are passed by, as first hits of pictures pass them by.
std::optional<ShapeHit> firstShape(std::span<const ShapeDescription> shapes, Vec3 origin, Vec3 direction, double t_min,
                                   double t_max);

/// Unit normal at a point of the shape: of boxes and spheres outwards.
Vec3 shapeNormal(const ShapeDescription& shape, Vec3 point);

} // namespace pointrt
