// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/shape_hit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/cast/ray_interval.h"

namespace pointrt {
namespace {

/// Two distances along a ray; infinite: no hit.
using Places = std::array<double, 2>;
constexpr Places kNowhere{kInfinity, kInfinity};

/// Rows of the matrix from the world to the shape's unit form.
struct UnitForm {
    Vec3 x, y, z;
    explicit UnitForm(const ShapeDescription& shape) {
        const Vec3 vw = cross(shape.v, shape.w), wu = cross(shape.w, shape.u), uv = cross(shape.u, shape.v);
        const double inverse = 1 / dot(shape.u, vw);
        x = inverse * vw;
        y = inverse * wu;
        z = inverse * uv;
    }
    Vec3 of(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

Places meetFlat(ShapeKind kind, Vec3 origin, Vec3 direction) {
    const double t = -origin.z / direction.z;
    const Vec3 at = origin + t * direction;
    const bool inside = kind == ShapeKind::kPlane || (kind == ShapeKind::kDisc && at.x * at.x + at.y * at.y <= 1) ||
                        (kind == ShapeKind::kQuad && std::max(std::abs(at.x), std::abs(at.y)) <= 1);
    return inside && direction.z != 0 ? Places{t, t} : kNowhere;
}

Places meetBox(Vec3 origin, Vec3 direction) {
    const RayInterval in = clipToBox({-kInfinity, kInfinity}, origin,
                                     {1 / direction.x, 1 / direction.y, 1 / direction.z}, {-1, -1, -1}, {1, 1, 1});
    return in.isEmpty() ? kNowhere : Places{in.from, in.to};
}

/// Solves relative to the ray's closest point to the centre, as the shader does: Haines et al., Ray Tracing Gems,
/// chapter 7.
Places meetSphere(Vec3 origin, Vec3 direction) {
    const double inverse = 1 / dot(direction, direction), middle = -dot(origin, direction) * inverse;
    const Vec3 nearest = origin + middle * direction;
    const double height = 1 - dot(nearest, nearest);
    if (height < 0) return kNowhere;
    const double half_chord = std::sqrt(height * inverse);
    return {middle - half_chord, middle + half_chord};
}

Places meetShape(const ShapeDescription& shape, Vec3 origin, Vec3 direction) {
    const UnitForm form(shape);
    const Vec3 from = form.of(origin - shape.center), along = form.of(direction);
    if (shape.kind == ShapeKind::kBox) return meetBox(from, along);
    return shape.kind == ShapeKind::kSphere ? meetSphere(from, along) : meetFlat(shape.kind, from, along);
}

double componentSign(double v) { return v < 0 ? -1 : 1; }

/// The normal of the unit box's face nearest to the point.
Vec3 faceNormal(Vec3 at) {
    const Vec3 size = absolute(at);
    if (size.x >= std::max(size.y, size.z)) return {componentSign(at.x), 0, 0};
    return size.y >= size.z ? Vec3{0, componentSign(at.y), 0} : Vec3{0, 0, componentSign(at.z)};
}

} // namespace

std::optional<ShapeHit> firstShape(std::span<const ShapeDescription> shapes, Vec3 origin, Vec3 direction, double t_min,
                                   double t_max) {
    std::optional<ShapeHit> first;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        if (!shapes[i].seen_by_camera || shapes[i].backdrop) continue;
        for (const double t : meetShape(shapes[i], origin, direction))
            if (t >= t_min && t < (first ? first->t : t_max)) first = {t, i};
    }
    return first;
}

Vec3 shapeNormal(const ShapeDescription& shape, Vec3 point) {
    const UnitForm form(shape);
    const Vec3 at = form.of(point - shape.center);
    Vec3 n{0, 0, 1};
    if (shape.kind == ShapeKind::kSphere) n = at;
    if (shape.kind == ShapeKind::kBox) n = faceNormal(at);
    return normalize(n.x * form.x + n.y * form.y + n.z * form.z); // normals transform by the transpose
}

} // namespace pointrt
