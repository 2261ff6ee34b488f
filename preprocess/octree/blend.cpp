// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/blend.h"

#include <algorithm>
#include <limits>

namespace pointrt {

void DiscList::clear() {
    for (int axis = 0; axis < 3; ++axis) {
        center[axis].clear();
        normal[axis].clear();
        color[axis].clear();
    }
    radius_squared.clear();
    kept.clear();
}

void DiscList::add(const Disc& disc, const Vec3f& rgb, bool keep) {
    for (int axis = 0; axis < 3; ++axis) {
        center[axis].push_back(disc.center[axis]);
        normal[axis].push_back(disc.normal[axis]);
        color[axis].push_back(rgb[axis]);
    }
    radius_squared.push_back(disc.radius * disc.radius);
    kept.push_back(keep);
}

void castRay(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max) {
    const std::size_t count = list.size();
    list.distance.resize(count);
    const float ox = origin.x(), oy = origin.y(), oz = origin.z();
    const float dx = direction.x(), dy = direction.y(), dz = direction.z();
    const float *cx = list.center[0].data(), *cy = list.center[1].data(), *cz = list.center[2].data();
    const float *nx = list.normal[0].data(), *ny = list.normal[1].data(), *nz = list.normal[2].data();
    const float* r2 = list.radius_squared.data();
    float* out = list.distance.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float x = cx[i] - ox, y = cy[i] - oy, z = cz[i] - oz;
        const float t = (nx[i] * x + ny[i] * y + nz[i] * z) / (nx[i] * dx + ny[i] * dy + nz[i] * dz);
        const float ax = t * dx - x, ay = t * dy - y, az = t * dz - z;
        const bool hit = (ax * ax + ay * ay + az * az < r2[i]) & (t >= 0.0f) & (t <= t_max);
        out[i] = hit ? t : std::numeric_limits<float>::infinity();
    }
}

void weighAt(DiscList& list, const Vec3f& point, const Vec3f& side, float front) {
    const std::size_t count = list.size();
    list.weight.resize(count);
    list.height.resize(count);
    list.turn.resize(count);
    const float px = point.x(), py = point.y(), pz = point.z();
    const float sx = side.x(), sy = side.y(), sz = side.z();
    const float *cx = list.center[0].data(), *cy = list.center[1].data(), *cz = list.center[2].data();
    const float *nx = list.normal[0].data(), *ny = list.normal[1].data(), *nz = list.normal[2].data();
    const float* r2 = list.radius_squared.data();
    float *weight = list.weight.data(), *height = list.height.data(), *turn = list.turn.data();
    const bool oriented = list.oriented;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = px - cx[i], y = py - cy[i], z = pz - cz[i];
        const float h = nx[i] * x + ny[i] * y + nz[i] * z;
        const float cosine = nx[i] * sx + ny[i] * sy + nz[i] * sz;
        const float to_viewer = oriented ? front : (cosine < 0.0f ? -1.0f : 1.0f);
        const float in_plane = std::max(0.0f, 1.0f - (x * x + y * y + z * z - h * h) / r2[i]);
        const float in_slab = std::max(0.0f, 1.0f - h * h / (kBlendSlab * kBlendSlab * r2[i]));
        const float product = in_plane * in_slab;
        weight[i] = to_viewer * cosine > kSameSideCosine ? product * product : 0.0f;
        height[i] = to_viewer * h;
        turn[i] = to_viewer;
    }
}

} // namespace pointrt
