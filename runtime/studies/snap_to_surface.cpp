// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/measure/given_points.h"
#include "runtime/studies/cast_batch.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/studies/study_values.h"

namespace pointrt {
namespace {

/// Number of directions over the sphere: every direction is within some 0.09 radians of one of them.
constexpr std::size_t kDirections = 1024;
/// The search then narrows around the nearest hit, by rings of rays in a cone. The cone's angle shrinks by this factor,
/// from one that reaches the neighbouring directions to 3e-6 radians, at which the relative error of the distance is
/// 5e-12.
constexpr double kFirstCone = 0.12, kShrink = 0.6;
constexpr int kRounds = 21;
constexpr std::size_t kRingRays = 8;
constexpr std::size_t kPointsAtOnce = 256; // the first search then takes 262,144 rays, a chunk of the library

/// A point and the nearest hit found so far.
struct Search {
    Vec3 point, direction;
    double distance = std::numeric_limits<double>::infinity();
};

/// Directions on a sphere (Fibonacci lattice).
std::vector<Vec3> sphereDirections() {
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const double z = 1 - (2.0 * static_cast<double>(i) + 1) / kDirections, ring = std::sqrt(1 - z * z);
        const double angle = kGoldenAngle * static_cast<double>(i);
        directions.push_back({ring * std::cos(angle), ring * std::sin(angle), z});
    }
    return directions;
}

/// Two rings around a direction.
void addCone(Vec3 direction, double cone, std::vector<Vec3>& directions) {
    const Vec3 aside = normalize(cross(direction, std::abs(direction.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const Vec3 across = cross(direction, aside);
    for (std::size_t k = 0; k < kRingRays; ++k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kRingRays;
        const Vec3 outwards = std::cos(angle) * aside + std::sin(angle) * across;
        for (const double tangent : {cone, cone / 2}) directions.push_back(normalize(direction + tangent * outwards));
    }
}

/// For each search in turn, casts the count rays of directionsOf(search) and keeps the nearest hit.
template <typename DirectionsOf>
void castEach(const TraceScene& scene, std::span<Search> searches, CastBatch& rays, const DirectionsOf& directionsOf) {
    rays.clear();
    std::vector<std::pair<std::size_t, Vec3>> cast;
    for (std::size_t i = 0; i < searches.size(); ++i)
        for (const Vec3& direction : directionsOf(searches[i])) {
            rays.add(searches[i].point, direction);
            cast.emplace_back(i, direction);
        }
    const std::span<const double> distances = rays.cast(scene);
    for (std::size_t k = 0; k < cast.size(); ++k) {
        Search& search = searches[cast[k].first];
        if (distances[k] >= search.distance) continue;
        search.distance = distances[k];
        search.direction = cast[k].second;
    }
}

void searchNearest(const TraceScene& scene, std::span<Search> searches, const std::vector<Vec3>& sphere) {
    CastBatch rays;
    castEach(scene, searches, rays, [&](const Search&) { return sphere; });
    double cone = kFirstCone;
    for (int round = 0; round < kRounds; ++round, cone *= kShrink)
        castEach(scene, searches, rays, [&](const Search& search) {
            std::vector<Vec3> directions;
            if (std::isfinite(search.distance)) addCone(search.direction, cone, directions);
            return directions;
        });
}

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

} // namespace

std::vector<Position> dropToSurface(const TraceScene& scene, std::span<const Position> points, const Position& up) {
    const std::vector<Vec3> given = vectorsOf(points, 0, "");
    if (given.empty()) return {};
    const PlanFrame frame = planFrame(given[0], up);
    const double top = planHeights(scene, frame).high;
    CastBatch rays;
    for (const Vec3& point : given) {
        const Vec3 plan = frame.planOf(point);
        rays.add(frame.pointAt({plan.x, plan.y, top}), -1.0 * frame.up);
    }
    std::vector<Position> dropped;
    const std::span<const double> distances = rays.cast(scene);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const Vec3 plan = frame.planOf(given[i]);
        dropped.push_back(std::isfinite(distances[i]) ? arrayOf(frame.pointAt({plan.x, plan.y, top - distances[i]}))
                                                      : Position{kNowhere, kNowhere, kNowhere});
    }
    return dropped;
}

std::vector<Position> snapToSurface(const TraceScene& scene, std::span<const Position> points) {
    const std::vector<Vec3> sphere = sphereDirections();
    std::vector<Search> searches;
    for (const Vec3& point : vectorsOf(points, 0, "")) searches.push_back({point, {}});
    for (std::size_t first = 0; first < searches.size(); first += kPointsAtOnce)
        searchNearest(scene, std::span(searches).subspan(first, std::min(kPointsAtOnce, searches.size() - first)),
                      sphere);
    std::vector<Position> snapped;
    for (const Search& search : searches) {
        snapped.push_back(std::isfinite(search.distance) ? arrayOf(search.point + search.distance * search.direction)
                                                         : Position{kNowhere, kNowhere, kNowhere});
    }
    return snapped;
}

} // namespace pointrt
