// SPDX-License-Identifier: Apache-2.0
// Render space: the frame that rays, shapes and lights share on the device, and the transforms to it. Transforms use
// doubles until the last rounding, so that scenes far from the origin (national grids) lose no precision: the device
// gets small numbers around the first instance's cube.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "pointrt/pro.h"
#include "runtime/scene/scene_description.h"
#include "runtime/util/pack.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {

/// space = (world - origin) / scale.
struct RenderSpace {
    Vec3 origin;      ///< world units
    double scale = 1; ///< world units per render unit, above 0
};

/// An axis-aligned box, world units.
struct Bounds {
    Vec3 lo, hi;
};

/// The space around the first instance: the origin is the low corner of its placed cube, the scale the edge of the
/// cube. If that instance is unmoved, render space is its cube's frame, exactly. Without instances: the low corner and
/// longest edge of the bounds of all bounded shapes; without those, world space.
/// @param infos of the instances' files, in order
RenderSpace chooseRenderSpace(const SceneDescription& scene, std::span<const pro_info> infos);

/// From an instance's input to world coordinates: `turned` rotates a direction; `placed` rotates, scales and translates
/// a point.
Vec3 turned(const Placement& placement, Vec3 input);
Vec3 placed(const Placement& placement, Vec3 input);
/// The inverse of placed: from the world to input coordinates.
Vec3 unplaced(const Placement& placement, Vec3 world);
/// A world direction rotated back by the placement's rotation, whose rows are orthonormal.
Vec3 unrotated(const Placement& placement, Vec3 direction);

Vec3 renderPoint(const RenderSpace& space, Vec3 world);
Vec3 worldPoint(const RenderSpace& space, Vec3 point);

/// Rows of the transform from render space to an instance's cube, [0,1)^3; exactly the identity for the first instance
/// if it is unmoved.
std::array<gpu::vec4, 3> cubeFromRender(const RenderSpace& space, const Placement& placement, const pro_info& info);

/// World bounds of the eight corners of an instance's bounds.
Bounds placedBounds(const Placement& placement, const pro_info& info);
/// Nullopt for planes, which are unbounded.
std::optional<Bounds> shapeBounds(const ShapeDescription& shape);
Bounds joined(const Bounds& a, const Bounds& b);
/// Bounds of all shapes except planes; nullopt if there are none.
std::optional<Bounds> boundsOfShapes(const SceneDescription& scene);

/// Requires that u, v and w are linearly independent, for every kind of shape.
gpu::Shape packShape(const RenderSpace& space, const ShapeDescription& shape);
/// Converts the lengths and the radiant intensity of a light to render units; radiance and the sun's irradiance do not
/// change.
gpu::Light packLight(const RenderSpace& space, const LightDescription& light);
/// Absorption is per render unit. The material belongs to no light.
gpu::Material packMaterial(const RenderSpace& space, const MaterialDescription& material);

/// The surface of an area light, nullopt for others.
/// @param material number of its material
std::optional<gpu::Shape> lampShape(const RenderSpace& space, const LightDescription& light, std::uint32_t material);
/// The material of that surface, which emits and does not reflect.
/// @param number of the light
std::optional<gpu::Material> lampMaterial(const LightDescription& light, std::uint32_t number);

} // namespace pointrt
