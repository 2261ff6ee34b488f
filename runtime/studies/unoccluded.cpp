// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/unoccluded.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "runtime/studies/row_slices.h"

namespace pointrt {
namespace {

/// Number of self-intersections that a ray may pass; after these it counts as unoccluded. The scattered points of one
/// surface are a few discs deep.
constexpr int kMostSelfHits = 32;
/// A ray continues this many radii behind a hit, to miss the same disc: positions in cells are rounded to a hundredth
/// of the radius.
constexpr double kBehind = 0.02;

/// The six numbers of each ray, computed on all cores; rayAt(i) returns origin and direction.
template <typename RayAt>
std::vector<double> numbersOf(std::size_t rays, const RayAt& rayAt) {
    std::vector<double> numbers(6 * rays);
    forSlices(rays, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto [origin, direction] = rayAt(i);
            const double row[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z};
            std::copy(std::begin(row), std::end(row), numbers.begin() + static_cast<std::ptrdiff_t>(6 * i));
        }
    });
    return numbers;
}

/// The remaining part of a ray within its self-intersection distance.
struct SelfSegment {
    std::size_t ray;
    Vec3 from;
    double length;
};

/// Tests the part of rays beyond their self-intersection distance, where any hit occludes.
std::uint64_t testBeyondSelf(const TraceScene& scene, std::span<const VisibilityRay> rays,
                             std::span<std::uint8_t> unoccluded) {
    const bool ends = !rays.empty() && std::isfinite(rays[0].length);
    const std::vector<double> numbers = numbersOf(rays.size(), [&](std::size_t i) {
        const VisibilityRay& ray = rays[i];
        const double rest = ends ? ray.length - ray.self_distance : 1;
        // directions must not be 0, so a ray that is complete gets one too short to hit anything
        return std::pair(ray.start + ray.self_distance * ray.direction, (rest > 0 ? rest : 1e-300) * ray.direction);
    });
    RayLimits limits;
    if (ends) limits.t_max = 1;
    scene.testOcclusions(std::span<const double>(numbers), limits, unoccluded);
    for (std::uint8_t& each : unoccluded) each = each == 0;
    return rays.size();
}

/// Casts segments. Keeps those that continue behind a self-intersection.
void passSelfHits(const TraceScene& scene, std::span<const VisibilityRay> rays, std::vector<SelfSegment>& segments,
                  std::span<std::uint8_t> unoccluded) {
    const std::vector<double> numbers = numbersOf(segments.size(), [&](std::size_t i) {
        return std::pair(segments[i].from, segments[i].length * rays[segments[i].ray].direction);
    });
    std::vector<double> t(segments.size());
    std::vector<float> normals(3 * segments.size());
    scene.castRays(std::span<const double>(numbers), {0, 1}, {.t_hit = t, .normals = normals});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (!std::isfinite(t[i])) continue;
        const VisibilityRay& ray = rays[segments[i].ray];
        const Vec3 normal{normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]};
        if (!isSelfIntersection(ray, normal)) {
            unoccluded[segments[i].ray] = 0;
            continue;
        }
        const double done = t[i] * segments[i].length;
        const Vec3 behind = segments[i].from + done * ray.direction - (kBehind * ray.radius) * normal;
        if (done < segments[i].length) segments[kept++] = {segments[i].ray, behind, segments[i].length - done};
    }
    segments.resize(kept);
}

} // namespace

std::uint64_t findUnoccluded(const TraceScene& scene, std::span<const VisibilityRay> rays,
                             std::span<std::uint8_t> unoccluded) {
    std::uint64_t cast = testBeyondSelf(scene, rays, unoccluded);
    std::vector<SelfSegment> segments;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (unoccluded[i] != 0 && rays[i].self_distance > 0)
            segments.push_back({i, rays[i].start, rays[i].self_distance});
    for (int hits = 0; hits < kMostSelfHits && !segments.empty(); ++hits) {
        cast += segments.size();
        passSelfHits(scene, rays, segments, unoccluded);
    }
    return cast;
}

} // namespace pointrt
