// SPDX-License-Identifier: Apache-2.0
// Render space: the frame that rays, shapes and lights share on the device, and how each part of a scene is put in it.
// Everything here is in doubles until the last rounding, so that a scene far from its origin (national grids) loses
// nothing: what the device gets is small numbers around the first instance's cube.
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
    double scale = 1; ///< world units in a render unit, above 0
};

/// A box along the axes, in world units.
struct Bounds {
    Vec3 lo, hi;
};

/// Around the first instance: origin at its cube's lowest corner as placed, scale its cube's edge. Where that instance
/// is not moved, render space is its cube's frame to the last bit. Without instances, the bounds of all shapes with an
/// extent: their lowest corner and longest edge; without those world units.
/// infos: of the instances' files, in their order.
RenderSpace chooseRenderSpace(const SceneDescription& scene, std::span<const pro_info> infos);

/// A direction, and a point, of an instance's input in the world.
Vec3 turned(const Placement& placement, Vec3 input);
Vec3 placed(const Placement& placement, Vec3 input);

Vec3 renderPoint(const RenderSpace& space, Vec3 world);
Vec3 worldPoint(const RenderSpace& space, Vec3 point);

/// Rows that take a point of render space into the cube of an instance, [0,1)^3; the unit matrix, exactly, for the
/// first instance where it is not moved.
std::array<gpu::vec4, 3> cubeFromRender(const RenderSpace& space, const Placement& placement, const pro_info& info);

/// The box around an instance's bounds as placed: around its eight corners.
Bounds placedBounds(const Placement& placement, const pro_info& info);
/// None for planes.
std::optional<Bounds> shapeBounds(const ShapeDescription& shape);
Bounds joined(const Bounds& a, const Bounds& b);
/// Around all shapes that are not planes; none without such.
std::optional<Bounds> boundsOfShapes(const SceneDescription& scene);

/// u, v and w of the description span space, whatever the kind.
gpu::Shape packShape(const RenderSpace& space, const ShapeDescription& shape);
/// The light in render units: lengths and radiant intensities change, radiance and the sun's irradiance do not.
gpu::Light packLight(const RenderSpace& space, const LightDescription& light);
/// Absorption is by render units. The material stands for no light.
gpu::Material packMaterial(const RenderSpace& space, const MaterialDescription& material);

/// The surface of a light that has one, with a material of this number.
std::optional<gpu::Shape> lampShape(const RenderSpace& space, const LightDescription& light, std::uint32_t material);
/// The material of that surface, which shines and reflects nothing; light: its number.
std::optional<gpu::Material> lampMaterial(const LightDescription& light, std::uint32_t number);

} // namespace pointrt
