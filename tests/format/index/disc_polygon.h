// SPDX-License-Identifier: Apache-2.0
// Intersections of discs and cubes as polygons, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pointrt/pro.h"
#include "runtime/util/vec.h"

namespace pointrt::test {

/// A cube in the cube's units.
struct Cube {
    Vec3 low;
    double edge = 0;
};

/// A splat as decoded from the file.
struct PlainDisc {
    Vec3 center, normal, u, v;
    double radius = 0;
};

inline PlainDisc plainDisc(const pro_splat& splat) {
    PlainDisc disc;
    disc.center = {splat.position[0], splat.position[1], splat.position[2]};
    disc.normal = normalize({splat.normal[0], splat.normal[1], splat.normal[2]});
    disc.u = normalize(cross(disc.normal, std::abs(disc.normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    disc.v = cross(disc.normal, disc.u);
    disc.radius = splat.radius;
    return disc;
}

using Polygon = std::vector<Vec3>;

/// The part of a polygon where inside(point), linear in the point, is not negative (Sutherland and Hodgman 1974).
template <typename Inside>
Polygon clip(const Polygon& polygon, const Inside& inside) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0) kept.push_back(a);
        if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return kept;
}

/// The part of the square around a disc inside a cube.
inline Polygon section(const PlainDisc& disc, const Cube& cube) {
    const Vec3 u = disc.u * disc.radius, v = disc.v * disc.radius, high = cube.low + Vec3{1, 1, 1} * cube.edge;
    Polygon polygon{disc.center - u - v, disc.center + u - v, disc.center + u + v, disc.center - u + v};
    polygon = clip(polygon, [&](Vec3 p) { return p.x - cube.low.x; });
    polygon = clip(polygon, [&](Vec3 p) { return high.x - p.x; });
    polygon = clip(polygon, [&](Vec3 p) { return p.y - cube.low.y; });
    polygon = clip(polygon, [&](Vec3 p) { return high.y - p.y; });
    polygon = clip(polygon, [&](Vec3 p) { return p.z - cube.low.z; });
    return clip(polygon, [&](Vec3 p) { return high.z - p.z; });
}

/// Distance from a disc's centre to the closest point of a polygon in its plane; infinite if the polygon is empty.
inline double distanceTo(const Polygon& polygon, const PlainDisc& disc) {
    double nearest = INFINITY;
    bool left = false, right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i] - disc.center, edge = polygon[(i + 1) % polygon.size()] - polygon[i];
        const double along = dot(edge, edge) > 0 ? std::clamp(-dot(a, edge) / dot(edge, edge), 0.0, 1.0) : 0;
        nearest = std::min(nearest, length(a + edge * along));
        (dot(cross(a, edge), disc.normal) < 0 ? left : right) = true;
    }
    return left != right && polygon.size() > 2 ? 0 : nearest;
}

inline bool crosses(const PlainDisc& disc, const Cube& cube) {
    return distanceTo(section(disc, cube), disc) <= disc.radius * (1 - 1e-9);
}

} // namespace pointrt::test
