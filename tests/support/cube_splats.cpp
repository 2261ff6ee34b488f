// SPDX-License-Identifier: Apache-2.0
#include "tests/support/cube_splats.h"

#include <algorithm>

#include "pointrt/pro.hpp"

namespace pointrt::test {

std::vector<CubeSplat> loadCubeSplats(const std::string& path) {
    const ProFile file(path);
    std::vector<CubeSplat> splats(file.info().splat_count);
    for (std::size_t s = 0; s < splats.size(); ++s) {
        const pro_splat plain = file.splat(s);
        const Vec3 normal = normalize({plain.normal[0], plain.normal[1], plain.normal[2]});
        splats[s] = {
            {plain.position[0], plain.position[1], plain.position[2]}, file.isBall(s) ? Vec3{} : normal, plain.radius};
    }
    return splats;
}

Sphere boundingSphere(std::span<const CubeSplat> splats) {
    Vec3 lo = splats.front().center, hi = lo;
    for (const CubeSplat& splat : splats) {
        lo = {std::min(lo.x, splat.center.x), std::min(lo.y, splat.center.y), std::min(lo.z, splat.center.z)};
        hi = {std::max(hi.x, splat.center.x), std::max(hi.y, splat.center.y), std::max(hi.z, splat.center.z)};
    }
    Sphere sphere{0.5 * (lo + hi), 0};
    for (const CubeSplat& splat : splats)
        sphere.radius = std::max(sphere.radius, length(splat.center - sphere.center) + splat.radius);
    return sphere;
}

DiscHit meetPlane(const CubeSplat& splat, Vec3 origin, Vec3 direction) {
    const double cosine = dot(splat.normal, direction);
    const Vec3 to_center = splat.center - origin;
    const double t = dot(splat.normal, to_center) / cosine;
    return {t, length(t * direction - to_center) / splat.radius, std::abs(cosine)};
}

} // namespace pointrt::test
