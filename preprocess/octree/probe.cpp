// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/probe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "format/base/blend_weight.h"
#include "preprocess/cloud/split_mix.h"

namespace pointrt {

namespace {

/// Additive recurrences: the k-th of 5 coordinates advances by phi_5^-k, phi_5 = 1.1347241384015194 the root of
/// x^6 = x + 1 (Roberts 2018).
constexpr std::array<double, 5> kSteps{0.8812714616335696, 0.7766393890897683, 0.6844301295853427, 0.6031687406857283,
                                       0.5315553977157914};

constexpr float kFullTurn = 6.28318530718f;

/// Distance to the boundary of the box from a point in it.
float exitDistance(const Box& box, const Vec3f& p, const Vec3f& direction) {
    float distance = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float d = direction[axis];
        if (d != 0.0f) distance = std::min(distance, ((d > 0.0f ? box.hi : box.lo)[axis] - p[axis]) / d);
    }
    return std::max(distance, 0.0f);
}

} // namespace

ProbeSequence::ProbeSequence(std::uint64_t seed, std::uint64_t leaf) {
    std::uint64_t state = mixBits(seed ^ mixBits(leaf));
    for (double& offset : offsets_) {
        state = mixBits(state);
        offset = unitShare(state);
    }
}

std::array<float, 5> ProbeSequence::next() {
    std::array<float, 5> sample;
    for (std::size_t k = 0; k < 5; ++k) {
        offsets_[k] += kSteps[k];
        offsets_[k] -= std::floor(offsets_[k]);
        sample[k] = static_cast<float>(offsets_[k]);
    }
    return sample;
}

Vec3f pointOnDisc(const Disc& disc, float u, float v) {
    if (disc.isBall()) return disc.center + disc.radius * sphereDirection(u, v);
    const Vec3f helper = std::abs(disc.normal.x()) < 0.5f ? Vec3f::UnitX() : Vec3f::UnitY();
    const Vec3f a = disc.normal.cross(helper).normalized(), b = disc.normal.cross(a);
    const float radius = disc.radius * std::sqrt(u), angle = kFullTurn * v; // the root makes it uniform over the area
    return disc.center + radius * (std::cos(angle) * a + std::sin(angle) * b);
}

Vec3f sphereDirection(float u, float v) {
    const float z = 1.0f - 2.0f * u, ring = std::sqrt(std::max(0.0f, 1.0f - z * z)), angle = kFullTurn * v;
    return {ring * std::cos(angle), ring * std::sin(angle), z};
}

Vec3f heaviestPoint(const Disc& disc, const Box& box, float slab) {
    // Projected gradient descent with the step size that solves for the height at once; in the disc's plane the
    // distance shrinks by 1 - slab^2 = 3/4 per iteration, to 1/30 after 12.
    constexpr int kIterations = 12;
    Vec3f point = disc.center.cwiseMax(box.lo).cwiseMin(box.hi);
    for (int i = 0; i < kIterations; ++i) {
        const Vec3f offset = point - disc.center;
        const float height = disc.normal.dot(offset);
        const Vec3f gradient = slab * slab * (offset - height * disc.normal) + height * disc.normal;
        point = (point - gradient).cwiseMax(box.lo).cwiseMin(box.hi);
    }
    return point;
}

float weightAt(const Disc& disc, const Vec3f& point, float slab) {
    const Vec3f offset = point - disc.center;
    const float r2 = disc.radius * disc.radius, height = disc.normal.dot(offset);
    const float in_plane = 1.0f - (offset.squaredNorm() - height * height) / r2;
    const float in_slab = 1.0f - height * height / (slab * slab * r2);
    return BLEND_IS_IN_REACH(in_plane, in_slab) ? BLEND_WEIGHT(in_plane, in_slab) : 0.0f;
}

bool contains(const Box& box, const Vec3f& p) {
    return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

Chord chordThrough(const Box& box, const Vec3f& point, const Vec3f& direction) {
    const float back = exitDistance(box, point, -direction);
    return {point - back * direction, direction, back + exitDistance(box, point, direction)};
}

} // namespace pointrt
