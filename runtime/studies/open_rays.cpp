// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/open_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "runtime/studies/slices.h"

namespace pointrt {
namespace {

/// Own surfaces that a ray passes; what is left after so many is open. A ray rises through the scatter of one surface,
/// in which a few discs lie over each other.
constexpr int kOwnHitsMost = 32;
/// Behind a disc that was met, so that it is not met again: discs in cells are rounded to a hundredth of their radius.
constexpr double kBehind = 0.02;

/// Six numbers of each ray, origin and direction, on all cores. put(ray) gives both.
template <typename Put>
std::vector<double> numbersOf(std::size_t rays, const Put& put) {
    std::vector<double> numbers(6 * rays);
    forSlices(rays, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto [origin, direction] = put(i);
            const double row[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z};
            std::copy(std::begin(row), std::end(row), numbers.begin() + static_cast<std::ptrdiff_t>(6 * i));
        }
    });
    return numbers;
}

/// What is left of a ray's way out of its own surface.
struct WayOut {
    std::size_t ray;
    Vec3 from;
    double left; ///< along the ray
};

/// Beyond the own surface: whether anything is hit tells all. Lengths are those of the directions.
std::uint64_t testFar(const TraceScene& scene, std::span<const Departure> rays, std::span<std::uint8_t> open) {
    const bool ends = !rays.empty() && std::isfinite(rays[0].length);
    const std::vector<double> numbers = numbersOf(rays.size(), [&](std::size_t i) {
        const Departure& ray = rays[i];
        const double rest = ends ? ray.length - ray.own_reach : 1;
        // of nothing a direction, which the limit makes nothing of again
        return std::pair(ray.start + ray.own_reach * ray.direction, (rest > 0 ? rest : 1e-300) * ray.direction);
    });
    RayLimits limits;
    if (ends) limits.t_max = 1;
    scene.testOcclusions(std::span<const double>(numbers), limits, open);
    for (std::uint8_t& each : open) each = each == 0;
    return rays.size();
}

/// First hits on the ways out; those that go on behind an own surface stay in ways.
void passOwn(const TraceScene& scene, std::span<const Departure> rays, std::vector<WayOut>& ways,
             std::span<std::uint8_t> open) {
    const std::vector<double> numbers = numbersOf(ways.size(), [&](std::size_t i) {
        return std::pair(ways[i].from, ways[i].left * rays[ways[i].ray].direction);
    });
    std::vector<double> t(ways.size());
    std::vector<float> normals(3 * ways.size());
    scene.castRays(std::span<const double>(numbers), {0, 1}, {.t_hit = t, .normals = normals});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (!std::isfinite(t[i])) continue;
        const Departure& ray = rays[ways[i].ray];
        const Vec3 normal{normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]};
        if (!isOwnSurface(ray, normal)) {
            open[ways[i].ray] = 0;
            continue;
        }
        const double done = t[i] * ways[i].left;
        const Vec3 behind = ways[i].from + done * ray.direction - (kBehind * ray.radius) * normal;
        if (done < ways[i].left) ways[kept++] = {ways[i].ray, behind, ways[i].left - done};
    }
    ways.resize(kept);
}

} // namespace

std::uint64_t findOpen(const TraceScene& scene, std::span<const Departure> rays, std::span<std::uint8_t> open) {
    std::uint64_t cast = testFar(scene, rays, open);
    std::vector<WayOut> ways;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (open[i] != 0 && rays[i].own_reach > 0) ways.push_back({i, rays[i].start, rays[i].own_reach});
    for (int hits = 0; hits < kOwnHitsMost && !ways.empty(); ++hits) {
        cast += ways.size();
        passOwn(scene, rays, ways, open);
    }
    return cast;
}

} // namespace pointrt
