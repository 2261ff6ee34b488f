// SPDX-License-Identifier: Apache-2.0
#include "tests/trace/reference.h"

#include <algorithm>

#include "pointrt/pro.hpp"

namespace pointrt::test {

namespace {

struct Sums {
    double weight = 0, height = 0;
    Vec3 normal;
};

/// Weighted sums over the splats whose slab contains point and whose normal, flipped if necessary, is within 60 degrees
/// of side. If their weights add up to less than 0.5, the plane of the disc hit first gets the rest.
Sums gather(const Reference& scene, const ReferenceSplat& first, Vec3 point, Vec3 side, double front) {
    Sums sums;
    for (const ReferenceSplat& splat : scene.splats) {
        const double cosine = dot(splat.normal, side);
        const double turn = scene.oriented ? front : (cosine < 0 ? -1.0 : 1.0);
        if (turn * cosine <= 0.5) continue;
        const Vec3 offset = point - splat.center;
        const double height = dot(splat.normal, offset);
        const double d2 = (dot(offset, offset) - height * height) / (splat.radius * splat.radius);
        const double slab = scene.blend_slab * splat.radius, h2 = height * height / (slab * slab);
        if (d2 >= 1 || h2 >= 1) continue;
        const double weight = (1 - d2) * (1 - d2) * (1 - h2) * (1 - h2);
        sums.weight += weight;
        sums.height += weight * turn * height;
        sums.normal = sums.normal + weight * turn * splat.normal;
    }
    const double missing = std::max(0.5 - sums.weight, 0.0);
    sums.weight += missing;
    sums.height += missing * dot(side, point - first.center);
    sums.normal = sums.normal + missing * side;
    return sums;
}

/// The weighted sum of the normals of splats that face the viewer and whose slabs contain point.
Vec3 frontsAt(const Reference& scene, Vec3 point, Vec3 direction) {
    Vec3 sum;
    for (const ReferenceSplat& splat : scene.splats) {
        if (dot(splat.normal, direction) >= 0) continue;
        const Vec3 offset = point - splat.center;
        const double height = dot(splat.normal, offset), slab = scene.blend_slab * splat.radius;
        const double d2 = (dot(offset, offset) - height * height) / (splat.radius * splat.radius);
        const double h2 = height * height / (slab * slab);
        if (d2 < 1 && h2 < 1) sum = sum + (1 - d2) * (1 - d2) * (1 - h2) * (1 - h2) * splat.normal;
    }
    return sum;
}

Vec3 facing(Vec3 normal, Vec3 direction) { return dot(normal, direction) > 0 ? -1.0 * normal : normal; }

double newton(const Sums& sums, Vec3 direction, double limit) {
    const double slope = dot(sums.normal, direction);
    return slope == 0 ? 0.0 : std::clamp(-sums.height / slope, -limit, limit);
}

} // namespace

Reference loadReference(const std::string& path) {
    const ProFile file(path);
    const pro_info& info = file.info();
    Reference scene;
    scene.blend_slab = info.blend_slab;
    scene.oriented = (info.flags & PRO_FLAG_ORIENTED) != 0;
    for (std::uint32_t s = 0; s < info.splat_count; ++s) {
        pro_splat splat;
        pro_splat_decode(file.view().splats + std::size_t{s} * PRO_SPLAT_WORDS, info.radius_max, info.radius_step,
                         &splat);
        const Vec3 unit{splat.position[0], splat.position[1], splat.position[2]};
        scene.splats.push_back({Vec3{info.origin[0], info.origin[1], info.origin[2]} + info.scale * unit,
                                normalize({splat.normal[0], splat.normal[1], splat.normal[2]}),
                                splat.radius * info.scale});
    }
    return scene;
}

std::optional<ReferenceHit> firstDisc(const Reference& scene, Vec3 origin, Vec3 direction, double t_max) {
    std::optional<ReferenceHit> best;
    for (std::size_t s = 0; s < scene.splats.size(); ++s) {
        const ReferenceSplat& splat = scene.splats[s];
        const double t = dot(splat.normal, splat.center - origin) / dot(splat.normal, direction);
        if (!(t > 0) || t >= (best ? best->t : t_max)) continue;
        const Vec3 offset = origin + t * direction - splat.center;
        if (dot(offset, offset) < splat.radius * splat.radius)
            best = {t, facing(splat.normal, direction), origin + t * direction, s};
    }
    return best;
}

std::optional<ReferenceHit> firstSurface(const Reference& scene, Vec3 origin, Vec3 direction) {
    auto hit = firstDisc(scene, origin, direction);
    if (!hit) return hit;
    const ReferenceSplat& first = scene.splats[hit->splat];
    Vec3 side = hit->normal;
    double front = dot(side, first.normal) < 0 ? -1 : 1;
    // a back that fronts cover belongs to their rim
    const Vec3 fronts = scene.oriented && front < 0 ? frontsAt(scene, hit->position, direction) : Vec3{};
    if (dot(fronts, fronts) > 0) side = normalize(fronts), front = 1;
    const double t_first = hit->t;
    Sums sums = gather(scene, first, origin + t_first * direction, side, front);
    double t = t_first + newton(sums, direction, first.radius);
    sums = gather(scene, first, origin + t * direction, side, front);
    t += newton(sums, direction, first.radius);
    hit->t = std::clamp(t, t_first - first.radius, t_first + first.radius);
    hit->normal = facing(normalize(sums.normal), direction);
    hit->position = origin + hit->t * direction;
    return hit;
}

} // namespace pointrt::test
