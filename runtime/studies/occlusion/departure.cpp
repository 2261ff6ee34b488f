// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/occlusion/departure.h"

#include <algorithm>
#include <limits>

namespace pointrt {
namespace {

// The numbers of shaders/trace/offset.glsl, and why they are what they are.
constexpr double kOwnHeight = 3, kOwnReach = 8;                 // radii: over the disc's plane, and along the ray
constexpr double kNoisyHeight = 5, kNoisyReach = 5 / 0.1736482; // standard deviations; sine of 10 degrees
constexpr double kNoiseMost = 1;                                // radii that noise counts up to
constexpr double kLift = 0.25;                                  // radii
constexpr double kOwnCosine = 0.5;                              // of 60 degrees

/// towards: unit length, on the side of normal
double ownReach(const StudyDisc& disc, Vec3 normal, Vec3 towards) {
    const double noise = std::min(disc.noise, kNoiseMost * disc.radius);
    const double height = std::max(kOwnHeight * disc.radius, kNoisyHeight * noise);
    const double reach = std::max(kOwnReach * disc.radius, kNoisyReach * noise);
    return std::min(height / std::max(dot(normal, towards), 1e-6), reach);
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
