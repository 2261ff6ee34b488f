// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_disc.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace pointrt {

namespace {

/// Members lie in a plane if their discs stay within this share of the covering radius of the merged disc's plane: true
/// on a sphere for a disc of half its radius.
constexpr float kFlat = 0.25f;

/// They lie side by side if their squared radii sum to at least this share of the covering one's. 999 in
/// 1000 groups in a plane, sampled on a jittered grid or at random, exceed it; 1 in 100 groups of discs at random
/// places in space, at least their width apart, does.
constexpr float kSideBySide = 0.5f;

/// Share of a member's radius that closes the surface: discs overlap by a factor of at least 1.2 (radii.cpp). Covering
/// no more keeps discs from growing beyond their spacing level by level: cells of 2.45 spacings extend 1.73 from their
/// middles, so that a radius of 1.48 spacings stays one.
constexpr float kClosing = 1 / 1.2f;

Vec3f turnedTo(const Vec3f& normal, const Vec3f& side, bool oriented) {
    return !oriented && normal.dot(side) < 0 ? Vec3f(-normal) : normal;
}

/// Area-weighted means, the sum of squared radii, and the area-weighted mean over the members of the others' sum.
struct Means {
    Vec3f position, normal;
    float squares = 0, others = 0;
};

Means meansOf(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented) {
    const Vec3f base = discs.positions[members.front()], side = discs.normals[members.front()];
    Vec3d place = Vec3d::Zero(), normal = Vec3d::Zero();
    double squares = 0, own = 0;
    for (const std::uint32_t i : members) {
        const double area = double{discs.radii[i]} * discs.radii[i];
        own += area * area;
        place += area * (discs.positions[i] - base).cast<double>();
        normal += area * turnedTo(discs.normals[i], side, oriented).cast<double>();
        squares += area;
    }
    const double length = normal.norm();
    return {base + (place / squares).cast<float>(), length > 0 ? Vec3f((normal / length).cast<float>()) : side,
            static_cast<float>(squares), static_cast<float>(squares - own / squares)};
}

/// Extent of the members: in the merged disc's plane, the distance of the parts that close the surface from the middle;
/// perpendicular to it, the distance of their discs from the plane.
struct Extent {
    float along = 0, off = 0;
};

Extent extentOf(const MergeDiscs& discs, std::span<const std::uint32_t> members, const Means& means) {
    Extent extent;
    for (const std::uint32_t i : members) {
        const Vec3f way = discs.positions[i] - means.position;
        const float height = way.dot(means.normal), cosine = discs.normals[i].dot(means.normal);
        const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
        extent.along = std::max(extent.along, (way - height * means.normal).norm() + kClosing * discs.radii[i]);
        extent.off = std::max(extent.off, std::abs(height) + sine * discs.radii[i]);
    }
    return extent;
}

/// Radius of a disc that rays hit as often as members scattered within `along` of its middle. Members occlude each
/// other, so with the sum of their areas a tree's shadow would grow level by level. The occluded part of each is what
/// the others cover, at random over `spread` discs of that radius. For two to eight discs in a cube, of radius 0.1 to
/// 0.45 of its edge, facing any direction, within 60 degrees of one, or nearly parallel in a flat cube, rays of all
/// directions hit 0.98 times as often as before (0.88 to 1.21); with the sum of the areas 1.09 times (0.93 to 1.42).
/// Balls cover twice the area of discs that face any direction.
float scatteredRadius(const Means& means, float along, bool balls) {
    const float spread = balls ? 0.6f : 1.2f, part = means.others / (spread * along * along);
    const float shown = part > 0 ? -std::expm1(-part) / part : 1;
    return std::min(std::sqrt(means.squares * shown), along);
}

float distanceToDisc(const Vec3f& point, const Vec3f& center, const Vec3f& normal, float radius) {
    const Vec3f way = point - center;
    const float height = way.dot(normal);
    const float beyond = std::max(0.0f, (way - height * normal).norm() - radius);
    return std::hypot(height, beyond);
}

/// The largest distance of eight points of the merged disc's rim from the members' discs.
float rimDistance(const MergeDiscs& discs, std::span<const std::uint32_t> members, const MergedDisc& merged) {
    constexpr int kPoints = 8; // the chord between two is at most 8% of the radius inside the rim
    const Vec3f u = merged.normal.unitOrthogonal(), v = merged.normal.cross(u);
    float farthest = 0;
    for (int k = 0; k < kPoints; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kPoints;
        const Vec3f point = merged.position + merged.radius * (std::cos(angle) * u + std::sin(angle) * v);
        float nearest = std::numeric_limits<float>::max();
        for (const std::uint32_t i : members)
            nearest = std::min(nearest, distanceToDisc(point, discs.positions[i], discs.normals[i], discs.radii[i]));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

/// The largest distance of fourteen points of the merged ball's surface from the members' balls.
float bulgeOf(const MergeDiscs& balls, std::span<const std::uint32_t> members, const MergedDisc& merged) {
    float farthest = 0;
    for (int code = 0; code < 27; ++code) {
        const Vec3f direction(float(code % 3 - 1), float(code / 3 % 3 - 1), float(code / 9 - 1));
        const float length = direction.norm();
        if (length < 0.5f || std::abs(length * length - 2) < 0.5f) continue; // faces and corners of a cube, not edges
        const Vec3f point = merged.position + merged.radius / length * direction;
        float nearest = std::numeric_limits<float>::max();
        for (const std::uint32_t i : members)
            nearest = std::min(nearest, (point - balls.positions[i]).norm() - balls.radii[i]);
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

MergedDisc mergeBalls(const MergeDiscs& balls, std::span<const std::uint32_t> members) {
    const Means means = meansOf(balls, members, true);
    float extent = 0;
    for (const std::uint32_t i : members)
        extent = std::max(extent, (balls.positions[i] - means.position).norm() + balls.radii[i]);
    MergedDisc merged{means.position, Vec3f::Zero(), scatteredRadius(means, extent, true), 0};
    merged.error = std::max(extent - merged.radius, bulgeOf(balls, members, merged));
    return merged;
}

/// The axes of largest and second largest variance of the positions.
struct Spread {
    Vec3f center, along, across;
};

Spread spreadOf(const MergeDiscs& discs, std::span<const std::uint32_t> members) {
    Vec3d center = Vec3d::Zero();
    for (const std::uint32_t i : members) center += discs.positions[i].cast<double>();
    center /= static_cast<double>(members.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const std::uint32_t i : members) {
        const Vec3d way = discs.positions[i].cast<double>() - center;
        covariance += way * way.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance); // ascending
    return {center.cast<float>(), solver.eigenvectors().col(2).cast<float>(),
            solver.eigenvectors().col(1).cast<float>()};
}

/// Half the extent of discs along an axis.
float halfReach(const MergeDiscs& discs, std::span<const std::uint32_t> members, const Vec3f& axis) {
    float low = std::numeric_limits<float>::max(), high = -low;
    for (const std::uint32_t i : members) {
        const float place = discs.positions[i].dot(axis);
        low = std::min(low, place - discs.radii[i]);
        high = std::max(high, place + discs.radii[i]);
    }
    return (high - low) / 2;
}

} // namespace

void splitLong(const MergeDiscs& discs, std::span<std::uint32_t> members, std::vector<std::uint32_t>& sizes) {
    constexpr float kLong = 2;
    const auto whole = static_cast<std::uint32_t>(members.size());
    if (members.size() < 2) return sizes.push_back(whole);
    const Spread spread = spreadOf(discs, members);
    if (halfReach(discs, members, spread.along) <= kLong * halfReach(discs, members, spread.across))
        return sizes.push_back(whole);
    const auto middle = std::stable_partition(members.begin(), members.end(), [&](std::uint32_t i) {
        return (discs.positions[i] - spread.center).dot(spread.along) < 0;
    });
    const auto first = static_cast<std::size_t>(middle - members.begin());
    if (first == 0 || first == members.size()) return sizes.push_back(whole); // all at one position
    splitLong(discs, members.first(first), sizes);
    splitLong(discs, members.subspan(first), sizes);
}

std::vector<std::uint32_t> groupBySide(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented) {
    std::vector<Vec3f> sums;
    std::vector<std::uint32_t> group_of;
    std::optional<std::uint32_t> balls; // their group
    for (const std::uint32_t i : members) {
        const Vec3f& normal = discs.normals[i];
        if (normal.isZero(0)) {
            if (!balls) balls = static_cast<std::uint32_t>(sums.size()), sums.push_back(Vec3f::Zero());
            group_of.push_back(*balls);
            continue;
        }
        float best = kSameSide;
        std::size_t group = sums.size();
        for (std::size_t g = 0; g < sums.size(); ++g) {
            const float cosine = normal.dot(sums[g].normalized());
            const float alike = oriented ? cosine : std::abs(cosine);
            if (alike < best) continue;
            best = alike;
            group = g;
        }
        if (group == sums.size()) sums.push_back(Vec3f::Zero());
        sums[group] += discs.radii[i] * discs.radii[i] * turnedTo(normal, sums[group], oriented);
        group_of.push_back(static_cast<std::uint32_t>(group));
    }
    return group_of;
}

MergedDisc mergeDiscs(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented) {
    if (members.size() == 1) {
        const std::uint32_t i = members.front();
        return {discs.positions[i], discs.normals[i], discs.radii[i], 0};
    }
    if (discs.normals[members.front()].isZero(0)) return mergeBalls(discs, members);
    const Means means = meansOf(discs, members, oriented);
    const Extent extent = extentOf(discs, members, means);
    const bool flat = extent.off <= kFlat * extent.along;
    const bool side_by_side = means.squares >= kSideBySide * extent.along * extent.along;
    const float area_radius = scatteredRadius(means, extent.along, false);
    MergedDisc merged{means.position, means.normal, flat && side_by_side ? extent.along : area_radius, 0};
    merged.error = std::max(extent.off, rimDistance(discs, members, merged));
    for (const std::uint32_t i : members) {
        const Vec3f way = discs.positions[i] - merged.position;
        const float along = (way - way.dot(merged.normal) * merged.normal).norm() + discs.radii[i];
        merged.error = std::max(merged.error, std::hypot(extent.off, std::max(0.0f, along - merged.radius)));
    }
    return merged;
}

} // namespace pointrt
