// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/blend.h"

#include <algorithm>

namespace pointrt {

namespace {

/// Distance along the ray to the disc, or a negative number.
float hitDisc(const Disc& disc, const Ray& ray) {
    const float slope = disc.normal.dot(ray.direction);
    if (slope == 0.0f) return -1.0f;
    const float t = disc.normal.dot(disc.center - ray.origin) / slope;
    const Vec3f offset = ray.origin + t * ray.direction - disc.center;
    return offset.squaredNorm() < disc.radius * disc.radius ? t : -1.0f;
}

bool firstHit(const DiscList& list, const Ray& ray, float t_min, float t_max, bool only_kept, SurfaceHit& hit) {
    hit.t = t_max;
    bool found = false;
    for (std::uint32_t i = 0; i < list.discs.size(); ++i) {
        if (only_kept && !list.kept[i]) continue;
        const float t = hitDisc(list.discs[i], ray);
        if (t < t_min || t >= hit.t) continue;
        hit.t = t;
        hit.first = i;
        found = true;
    }
    return found;
}

Vec3f facing(const Vec3f& normal, const Vec3f& direction) { return normal.dot(direction) > 0.0f ? Vec3f(-normal) : normal; }

} // namespace

float blendWeight(const Disc& disc, const Vec3f& point, float& height) {
    const Vec3f offset = point - disc.center;
    height = disc.normal.dot(offset);
    const float radius_squared = disc.radius * disc.radius;
    const float in_plane = 1.0f - (offset.squaredNorm() - height * height) / radius_squared;
    const float in_slab = 1.0f - height * height / (kBlendSlab * kBlendSlab * radius_squared);
    if (in_plane <= 0.0f || in_slab <= 0.0f) return 0.0f;
    return in_plane * in_plane * in_slab * in_slab;
}

bool intersectBlended(const DiscList& list, const Ray& ray, float t_min, float t_max, bool only_kept, SurfaceHit& hit) {
    if (!firstHit(list, ray, t_min, t_max, only_kept, hit)) return false;
    const Disc& first = list.discs[hit.first];
    const Vec3f side = facing(first.normal, ray.direction);
    const float front = list.oriented && side.dot(first.normal) < 0.0f ? -1.0f : 1.0f;
    const Vec3f point = ray.origin + hit.t * ray.direction;
    hit.normal = side;
    hit.radius = first.radius;
    hit.color = list.colors.empty() ? Vec3f(Vec3f::Zero()) : list.colors[hit.first];
    Vec3f normal = Vec3f::Zero(), color = Vec3f::Zero();
    float height = 0, weight = 0;
    for (std::size_t i = 0; i < list.discs.size(); ++i) {
        if (only_kept && !list.kept[i]) continue;
        const float cosine = side.dot(list.discs[i].normal);
        const float sign = list.oriented ? front : (cosine < 0.0f ? -1.0f : 1.0f);
        if (sign * cosine <= kSameSideCosine) continue;
        float h;
        const float w = blendWeight(list.discs[i], point, h);
        if (w == 0.0f) continue;
        weight += w;
        height += w * sign * h;
        normal += w * sign * list.discs[i].normal;
        if (!list.colors.empty()) color += w * list.colors[i];
    }
    if (weight <= 0.0f) return true;
    const float slope = normal.dot(ray.direction);
    const float step = slope == 0.0f ? 0.0f : -height / slope;
    hit.t += std::clamp(step, -first.radius, first.radius);
    hit.normal = facing(normal.normalized(), ray.direction);
    hit.color = color / weight;
    return true;
}

} // namespace pointrt
