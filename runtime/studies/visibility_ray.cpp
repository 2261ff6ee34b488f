// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/visibility_ray.h"

#include <algorithm>
#include <limits>

namespace pointrt {
namespace {

// shaders/trace/offset.glsl derives these constants.
constexpr double kSelfHeight = 3;   // radii above the disc's plane
constexpr double kNoisyHeight = 5;  // standard deviations
constexpr double kNoiseMost = 1;    // upper limit of the noise, in radii
constexpr double kLift = 0.25;      // radii
constexpr double kSelfCosine = 0.5; // of 60 degrees

/// Sine of 2 degrees: rays at lower elevations keep the self-intersection distance of this one. Pictures limit it to 8
/// radii, as light at grazing angles contributes little. In hours of sun, all angles count alike: with 8 radii, the
/// scatter that remains after a bake (a third of a radius) would shade a tenth of level ground from a sun at 6 degrees,
/// and a quarter at 4 degrees.
constexpr double kLeastRise = 0.0348995;

/// @param towards unit length, on the side of normal
double selfDistance(const StudyDisc& disc, Vec3 normal, Vec3 towards) {
    const double noise = std::min(disc.noise, kNoiseMost * disc.radius);
    return std::max(kSelfHeight * disc.radius, kNoisyHeight * noise) / std::max(dot(normal, towards), kLeastRise);
}

Vec3 sideOf(const StudyDisc& disc, Vec3 towards) {
    return dot(disc.normal, towards) < 0 ? -1.0 * disc.normal : disc.normal;
}

} // namespace

bool isFacing(const StudyDisc& disc, Vec3 towards) { return !disc.one_sided || dot(disc.normal, towards) > 0; }

VisibilityRay rayToLight(const StudyDisc& disc, Vec3 towards) {
    const Vec3 normal = sideOf(disc, towards);
    return {
        disc.center + normal * (kLift * disc.radius), towards, normal, disc.radius, selfDistance(disc, normal, towards),
        std::numeric_limits<double>::infinity()};
}

VisibilityRay rayToObserver(const StudyDisc& disc, Vec3 eye) {
    const Vec3 normal = sideOf(disc, eye - disc.center);
    const Vec3 lifted = disc.center + normal * (kLift * disc.radius);
    const Vec3 start = length(eye - lifted) > 0 ? lifted : disc.center;
    const double distance = length(eye - start);
    const Vec3 towards = (1 / distance) * (eye - start);
    return {start, towards, normal, disc.radius, std::min(selfDistance(disc, normal, towards), distance), distance};
}

bool isSelfIntersection(const VisibilityRay& ray, Vec3 hit_normal) {
    return dot(ray.normal, hit_normal) < -kSelfCosine;
}

} // namespace pointrt
