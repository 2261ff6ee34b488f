// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/departure.h"

#include <algorithm>
#include <limits>

namespace pointrt {
namespace {

// The numbers of shaders/trace/offset.glsl, and why they are what they are.
constexpr double kOwnHeight = 3;   // radii over the disc's plane
constexpr double kNoisyHeight = 5; // standard deviations
constexpr double kNoiseMost = 1;   // radii that noise counts up to
constexpr double kLift = 0.25;     // radii
constexpr double kOwnCosine = 0.5; // of 60 degrees

/// Rays that rise less count as rising so much: 2 degrees. Pictures end own surfaces sooner, 8 radii along the ray:
/// what is lit at such angles is dark there. Hours do not get fewer with the angle, and scatter that no bake has
/// cleaned off (a third of a radius) hides a tenth of level ground from a sun of 6 degrees, a quarter of it at 4, if 8
/// radii end it.
constexpr double kLeastRise = 0.0348995;

/// towards: unit length, on the side of normal
double ownReach(const StudyDisc& disc, Vec3 normal, Vec3 towards) {
    const double noise = std::min(disc.noise, kNoiseMost * disc.radius);
    return std::max(kOwnHeight * disc.radius, kNoisyHeight * noise) / std::max(dot(normal, towards), kLeastRise);
}

Vec3 sideOf(const StudyDisc& disc, Vec3 towards) {
    return dot(disc.normal, towards) < 0 ? -1.0 * disc.normal : disc.normal;
}

} // namespace

bool isFaced(const StudyDisc& disc, Vec3 towards) { return !disc.one_sided || dot(disc.normal, towards) > 0; }

Departure leaveTowards(const StudyDisc& disc, Vec3 towards) {
    const Vec3 normal = sideOf(disc, towards);
    return {disc.center + normal * (kLift * disc.radius), towards, normal, disc.radius, ownReach(disc, normal, towards),
            std::numeric_limits<double>::infinity()};
}

Departure leaveFor(const StudyDisc& disc, Vec3 eye) {
    const Vec3 normal = sideOf(disc, eye - disc.center);
    const Vec3 lifted = disc.center + normal * (kLift * disc.radius);
    const Vec3 start = length(eye - lifted) > 0 ? lifted : disc.center;
    const double distance = length(eye - start);
    const Vec3 towards = (1 / distance) * (eye - start);
    return {start, towards, normal, disc.radius, std::min(ownReach(disc, normal, towards), distance), distance};
}

bool isOwnSurface(const Departure& ray, Vec3 hit_normal) { return dot(ray.normal, hit_normal) < -kOwnCosine; }

} // namespace pointrt
