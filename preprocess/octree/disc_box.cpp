// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/disc_box.h"

#include <algorithm>
#include <limits>

namespace pointrt {

namespace {

/// Clips [s0, s1] to lo <= start + s * step <= hi.
void clipInterval(float start, float step, float lo, float hi, float& s0, float& s1) {
    if (std::abs(step) < 1e-12f) { // parallel to the slab: inside everywhere or nowhere
        if (start < lo || start > hi) s1 = -std::numeric_limits<float>::infinity();
        return;
    }
    const float a = (lo - start) / step, b = (hi - start) / step;
    s0 = std::max(s0, std::min(a, b));
    s1 = std::min(s1, std::max(a, b));
}

} // namespace

float faceDistanceSquared(const Disc& disc, const Box& box, int axis, float plane) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const float nu = disc.normal[u], nv = disc.normal[v];
    const float in_face = nu * nu + nv * nv;
    if (in_face < 1e-12f) return kInfinity; // the disc is parallel to the face
    const float depth = plane - disc.center[axis];
    const float offset = -disc.normal[axis] * depth / in_face;
    const float start_u = disc.center[u] + offset * nu, start_v = disc.center[v] + offset * nv;
    float s0 = -kInfinity, s1 = kInfinity;
    clipInterval(start_u, -nv, box.lo[u], box.hi[u], s0, s1);
    clipInterval(start_v, nu, box.lo[v], box.hi[v], s0, s1);
    if (s0 > s1) return kInfinity;
    const float s = std::clamp(0.0f, s0, s1);
    return depth * depth + (offset * offset + s * s) * in_face;
}

float sectionDistanceSquared(const Disc& disc, const Box& box) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (disc.isBall()) return (disc.center.cwiseMax(box.lo).cwiseMin(box.hi) - disc.center).squaredNorm();
    const Vec3f half = 0.5f * (box.hi - box.lo);
    const float plane_distance = std::abs(disc.normal.dot(disc.center - 0.5f * (box.lo + box.hi)));
    if (plane_distance > half.dot(disc.normal.cwiseAbs())) return kInfinity;
    float nearest = kInfinity;
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
        const float c = disc.center[axis];
        if (c >= box.lo[axis] && c <= box.hi[axis]) continue;
        inside = false;
        const float plane = c < box.lo[axis] ? box.lo[axis] : box.hi[axis];
        nearest = std::min(nearest, faceDistanceSquared(disc, box, axis, plane));
    }
    return inside ? 0.0f : nearest;
}

bool discOverlapsBox(const Disc& disc, const Box& box) {
    const Vec3f reach = discReach(disc);
    if (((disc.center - reach).array() > box.hi.array()).any() ||
        ((disc.center + reach).array() < box.lo.array()).any())
        return false;
    return sectionDistanceSquared(disc, box) <= disc.radius * disc.radius;
}

} // namespace pointrt
