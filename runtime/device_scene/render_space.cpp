// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/render_space.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace pointrt {

namespace {

using Rows = std::array<Vec3, 3>;

Vec3 applied(const Rows& rows, Vec3 v) { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

Rows transposed(const Rows& r) {
    return {Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y}, Vec3{r[0].z, r[1].z, r[2].z}};
}

Vec3 vecOf(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Half extents of the bounds of the ellipsoid or ellipse with half axes u, v and w.
Vec3 roundHalf(Vec3 u, Vec3 v, Vec3 w) {
    return {std::hypot(u.x, v.x, w.x), std::hypot(u.y, v.y, w.y), std::hypot(u.z, v.z, w.z)};
}

/// Converts the fields of a light to render units.
struct ToRenderUnits {
    RenderSpace space;

    void operator()(const PositionField& field) const { field.value = renderPoint(space, field.value); }
    void operator()(const AimField&) const {}
    void operator()(const SunwardField&) const {}
    void operator()(const ConeField&) const {}
    void operator()(const AngularRadiusField&) const {}
    void operator()(const RadiusField& field) const { field.value = field.value / space.scale; }
    void operator()(const HalfEdgesField& field) const {
        const double units = 1.0 / space.scale;
        field.u = units * field.u;
        field.v = units * field.v;
    }
    void operator()(const VisibleField&) const {}
    void operator()(const LayerField&) const {}
    void operator()(const EmissionField& field) const {
        if (field.quantity == EmissionField::Quantity::kIntensity)
            field.value = scaled(field.value, 1.0 / (space.scale * space.scale));
    }
};

constexpr std::array<std::uint32_t, 5> kShapeKinds = {SHAPE_PLANE, SHAPE_DISC, SHAPE_QUAD, SHAPE_BOX, SHAPE_SPHERE};

template <typename Kind, typename Number, std::size_t N>
Number numberOf(const std::array<Number, N>& numbers, Kind kind) {
    return numbers.at(static_cast<std::size_t>(kind));
}

/// A shape as the transform to its unit form.
gpu::Shape placedForm(const RenderSpace& space, const LampSurface& surface, std::uint32_t material,
                      std::uint32_t bits) {
    const auto& [kind, center, u, v, w, seen_by_camera] = surface;
    const Vec3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
    // rows of the inverse of the matrix with the columns u, v and w
    const double inverse = 1.0 / dot(u, vw);
    const Rows local_from_world{inverse * vw, inverse * wu, inverse * uv};
    const Vec3 origin = applied(local_from_world, space.origin - center);
    return {pack(space.scale * local_from_world[0], origin.x),
            pack(space.scale * local_from_world[1], origin.y),
            pack(space.scale * local_from_world[2], origin.z),
            {kind, material, (seen_by_camera ? 0 : SHAPE_UNSEEN_BY_CAMERA) | bits, 0}};
}

} // namespace

Vec3 turned(const Placement& placement, Vec3 input) { return applied(placement.rotation, input); }

Vec3 placed(const Placement& placement, Vec3 input) {
    return placement.translation + placement.scale * turned(placement, input);
}

Vec3 unplaced(const Placement& placement, Vec3 world) {
    return unrotated(placement, world - placement.translation) * (1 / placement.scale);
}

Vec3 unrotated(const Placement& placement, Vec3 direction) {
    const std::array<Vec3, 3>& r = placement.rotation;
    return direction.x * r[0] + direction.y * r[1] + direction.z * r[2];
}

RenderSpace chooseRenderSpace(const SceneDescription& scene, std::span<const pro_info> infos) {
    if (!scene.instances.empty() && !infos.empty()) {
        const Placement& placement = scene.instances.front().placement;
        // the low corner in the cube's own frame, so that unmoved render space equals that frame
        return {placed(placement, vecOf(infos.front().origin)), placement.scale * infos.front().scale};
    }
    const std::optional<Bounds> bounds = boundsOfShapes(scene);
    if (!bounds) return {};
    const Vec3 size = bounds->hi - bounds->lo;
    const double longest = std::max({size.x, size.y, size.z});
    return longest > 0 ? RenderSpace{bounds->lo, longest} : RenderSpace{};
}

Vec3 renderPoint(const RenderSpace& space, Vec3 world) { return (world - space.origin) * (1.0 / space.scale); }

Vec3 worldPoint(const RenderSpace& space, Vec3 point) { return space.origin + space.scale * point; }

std::array<gpu::vec4, 3> cubeFromRender(const RenderSpace& space, const Placement& placement, const pro_info& info) {
    const Rows turned_back = transposed(placement.rotation);
    // the same product as in chooseRenderSpace, so that the ratio is exactly 1 for the first instance
    const double units = space.scale / (placement.scale * info.scale);
    const Vec3 input_origin = applied(turned_back, space.origin - placement.translation) * (1.0 / placement.scale);
    const Vec3 origin = (input_origin - vecOf(info.origin)) * (1.0 / info.scale);
    return {pack(units * turned_back[0], origin.x), pack(units * turned_back[1], origin.y),
            pack(units * turned_back[2], origin.z)};
}

Bounds placedBounds(const Placement& placement, const pro_info& info) {
    const Vec3 lo = vecOf(info.bounds_min), hi = vecOf(info.bounds_max);
    const Vec3 center = placed(placement, 0.5 * (lo + hi)), half = 0.5 * (hi - lo);
    const Rows& r = placement.rotation;
    const Vec3 reach =
        placement.scale * Vec3{dot(absolute(r[0]), half), dot(absolute(r[1]), half), dot(absolute(r[2]), half)};
    return {center - reach, center + reach};
}

std::optional<Bounds> shapeBounds(const ShapeDescription& shape) {
    Vec3 half;
    switch (shape.kind) {
    case ShapeKind::kPlane:
        return std::nullopt;
    case ShapeKind::kDisc:
        half = roundHalf(shape.u, shape.v, {});
        break;
    case ShapeKind::kQuad:
        half = absolute(shape.u) + absolute(shape.v);
        break;
    case ShapeKind::kBox:
        half = absolute(shape.u) + absolute(shape.v) + absolute(shape.w);
        break;
    case ShapeKind::kSphere:
        half = roundHalf(shape.u, shape.v, shape.w);
        break;
    }
    return Bounds{shape.center - half, shape.center + half};
}

Bounds joined(const Bounds& a, const Bounds& b) {
    return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
            {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

std::optional<Bounds> boundsOfShapes(const SceneDescription& scene) {
    std::optional<Bounds> all;
    for (const ShapeDescription& shape : scene.shapes)
        if (const auto bounds = shape.visible ? shapeBounds(shape) : std::nullopt)
            all = all ? joined(*all, *bounds) : *bounds;
    return all;
}

gpu::Shape packShape(const RenderSpace& space, const ShapeDescription& shape) {
    return placedForm(
        space, {numberOf(kShapeKinds, shape.kind), shape.center, shape.u, shape.v, shape.w, shape.seen_by_camera},
        shape.material, shape.backdrop ? SHAPE_BACKDROP : 0);
}

gpu::Light packLight(const RenderSpace& space, const LightDescription& light) {
    LightDescription rendered = light;
    std::visit([&](auto& kind) { kind.eachField(ToRenderUnits{space}); }, rendered);
    return rowOf(rendered);
}

gpu::Material packMaterial(const RenderSpace& space, const MaterialDescription& material) {
    const std::uint32_t bits =
        (material.splat_color ? MATERIAL_USES_SPLAT_COLOR : 0u) | (material.thin ? MATERIAL_THIN : 0u);
    return {packColor(material.color, std::bit_cast<float>(bits)),
            {static_cast<float>(material.kind), material.roughness, material.index, material.mirror_share},
            {material.specular, material.shininess, 0, 0},
            packColor(material.emission, std::bit_cast<float>(NO_LIGHT)),
            packColor(scaled(material.absorption, space.scale))};
}

std::optional<gpu::Shape> lampShape(const RenderSpace& space, const LightDescription& light, std::uint32_t material) {
    const auto surface = surfaceOf(light);
    return surface ? std::optional(placedForm(space, *surface, material, 0)) : std::nullopt;
}

std::optional<gpu::Material> lampMaterial(const LightDescription& light, std::uint32_t number) {
    if (!hasSurface(light.index())) return std::nullopt;
    LightDescription lamp = light;
    gpu::Material material{};
    material.emission = packColor(emissionField(lamp).value, std::bit_cast<float>(number));
    return material;
}

} // namespace pointrt
