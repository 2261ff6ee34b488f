// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/shape_edit.h"

#include <cmath>
#include <string>

#include "runtime/window/edit/material_edit.h"

namespace pointrt {
namespace {

/// A new material name, so that materials can be distinguished in lists.
std::string freeMaterialName(const SceneDescription& scene) {
    std::size_t number = 1;
    while (isMaterialNamed(scene, "shape " + std::to_string(number))) ++number;
    return "shape " + std::to_string(number);
}

/// Sets the axes of a shape that stands upright and faces the eye. w is up; for panes, w is the normal.
void orient(ShapeDescription& shape, const ShapePlace& place) {
    const double half = place.size / 2;
    const Vec3 right = normalize(cross(place.up, place.towards_eye)), front = cross(right, place.up);
    switch (shape.kind) {
    case ShapeKind::kSphere:
    case ShapeKind::kBox:
        shape.u = half * right;
        shape.v = -half * front;
        shape.w = half * place.up;
        return;
    case ShapeKind::kQuad:
    case ShapeKind::kDisc:
    case ShapeKind::kPlane:
        shape.u = half * right;
        shape.v = half * place.up;
        shape.w = front;
        return;
    }
}

} // namespace

void addShape(SceneDescription& scene, ShapeKind kind, const ShapePlace& place) {
    MaterialDescription material;
    material.name = freeMaterialName(scene);
    scene.materials.push_back(material);
    ShapeDescription shape;
    shape.kind = kind;
    shape.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    orient(shape, place);
    restOn(shape, place.point, place.normal);
    scene.shapes.push_back(shape);
}

void restOn(ShapeDescription& shape, Vec3 point, Vec3 normal) {
    shape.center = point + reachAlong(shape, normal) * normal;
}

double reachAlong(const ShapeDescription& shape, Vec3 direction) {
    const double u = dot(shape.u, direction), v = dot(shape.v, direction), w = dot(shape.w, direction);
    switch (shape.kind) {
    case ShapeKind::kPlane:
        return 0;
    case ShapeKind::kDisc:
        return std::hypot(u, v);
    case ShapeKind::kQuad:
        return std::abs(u) + std::abs(v);
    case ShapeKind::kBox:
        return std::abs(u) + std::abs(v) + std::abs(w);
    case ShapeKind::kSphere:
        return std::hypot(u, v, w);
    }
    return 0;
}

} // namespace pointrt
