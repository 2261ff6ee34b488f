// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/clip_polygon.h"

#include <cstddef>

namespace pointrt {
namespace {

/// The part where sign * coordinate <= sign * limit (Sutherland and Hodgman 1974).
std::vector<PlanePoint> cutAt(const std::vector<PlanePoint>& polygon, std::size_t axis, double limit, double sign) {
    std::vector<PlanePoint> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePoint &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double before = sign * (from[axis] - limit), after = sign * (to[axis] - limit);
        if (before <= 0) kept.push_back(from);
        if ((before < 0 && after > 0) || (before > 0 && after < 0)) {
            const double share = before / (before - after);
            PlanePoint on{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
            on[axis] = limit;
            kept.push_back(on);
        }
    }
    return kept;
}

} // namespace

PlaneArea areaOf(const std::vector<PlanePoint>& polygon) {
    PlaneArea sum;
    // triangles from the first corner, with coordinates relative to it
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const PlanePoint &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        const double u[] = {b[0] - a[0], b[1] - a[1]}, v[] = {c[0] - a[0], c[1] - a[1]};
        const double area = (u[0] * v[1] - u[1] * v[0]) / 2;
        sum.area += area;
        for (std::size_t axis = 0; axis < 2; ++axis) sum.centroid[axis] += area * (u[axis] + v[axis]) / 3;
    }
    for (std::size_t axis = 0; axis < 2 && sum.area != 0; ++axis)
        sum.centroid[axis] = polygon[0][axis] + sum.centroid[axis] / sum.area;
    return sum;
}

std::vector<PlanePoint> clippedTo(const std::vector<PlanePoint>& polygon, std::size_t axis, double low, double high) {
    return cutAt(cutAt(polygon, axis, high, 1), axis, low, -1);
}

} // namespace pointrt
