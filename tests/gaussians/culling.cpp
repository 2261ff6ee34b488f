// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/culling.h"

#include <algorithm>
#include <cmath>

namespace pointrt::test {

namespace {

/// Relative margin of all tests: much larger than rounding errors, much smaller than a pixel.
constexpr double kMargin = 1e-9;

SeenEllipsoid seenEllipsoid(const Double3& eye, const OracleTransform& transform) {
    SeenEllipsoid seen;
    if (transform.reach_squared < 0) return seen;
    const double reach = std::sqrt(transform.reach_squared);
    double radius = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Double3& row = transform.rows[k];
        seen.half_axes[k] = times(reach / dot(row, row), row);
        radius = std::max(radius, length(seen.half_axes[k]));
    }
    seen.center = minus(transform.mean, eye);
    const double distance = length(seen.center);
    seen.encloses_eye = radius >= distance * (1 - kMargin);
    if (seen.encloses_eye) return seen;
    seen.direction = times(1 / distance, seen.center);
    seen.sine = radius / distance;
    seen.cosine = std::sqrt(1 - seen.sine * seen.sine);
    return seen;
}

/// All rays through a rectangle, and the cone around them.
struct Pyramid {
    std::array<Double3, 4> inwards; ///< unit normals of its sides
    Double3 axis{};
    double sine = 0, cosine = 1; ///< of the cone's half angle
};

Pyramid pyramidOf(const OracleCamera& camera, PixelRectangle r) {
    const std::array<Double3, 4> corners = {
        rayThrough(camera, r.left, r.top).direction, rayThrough(camera, r.right, r.top).direction,
        rayThrough(camera, r.right, r.bottom).direction, rayThrough(camera, r.left, r.bottom).direction};
    Pyramid pyramid;
    pyramid.axis = rayThrough(camera, 0.5 * (r.left + r.right), 0.5 * (r.top + r.bottom)).direction;
    for (std::size_t k = 0; k < 4; ++k) {
        const Double3 normal = unit(cross(corners[k], corners[(k + 1) % 4]));
        pyramid.inwards[k] = times(dot(normal, pyramid.axis) < 0 ? -1 : 1, normal);
        // a cone narrower than a right angle is convex, so it contains everything between the corners
        pyramid.cosine = std::min(pyramid.cosine, dot(corners[k], pyramid.axis));
    }
    pyramid.sine = std::sqrt(std::max(0.0, 1 - pyramid.cosine * pyramid.cosine));
    return pyramid;
}

bool meetsCone(const SeenEllipsoid& seen, const Pyramid& pyramid) {
    if (seen.encloses_eye) return true;
    // the cosine of the sum of both angles, which is below two right angles
    const double farthest = pyramid.cosine * seen.cosine - pyramid.sine * seen.sine;
    return dot(pyramid.axis, seen.direction) >= farthest - kMargin;
}

/// Half of the ellipsoid's extent along a unit vector.
double extentAlong(const SeenEllipsoid& seen, const Double3& normal) {
    const Double3 shares{dot(seen.half_axes[0], normal), dot(seen.half_axes[1], normal),
                         dot(seen.half_axes[2], normal)};
    return length(shares);
}

bool meetsSides(const SeenEllipsoid& seen, const Pyramid& pyramid) {
    const double slack = kMargin * length(seen.center);
    return std::none_of(pyramid.inwards.begin(), pyramid.inwards.end(), [&](const Double3& inwards) {
        return dot(seen.center, inwards) + extentAlong(seen, inwards) * (1 + kMargin) + slack < 0;
    });
}

bool countsSomewhere(const SeenEllipsoid& seen) { return length(seen.half_axes[0]) > 0; }

} // namespace

std::vector<SeenEllipsoid> ellipsoidsFrom(const Double3& eye, const OracleScene& scene) {
    std::vector<SeenEllipsoid> ellipsoids;
    ellipsoids.reserve(scene.transforms.size());
    for (const OracleTransform& transform : scene.transforms) ellipsoids.push_back(seenEllipsoid(eye, transform));
    return ellipsoids;
}

std::vector<std::uint32_t> seenThrough(const OracleCamera& camera, PixelRectangle rectangle,
                                       std::span<const SeenEllipsoid> ellipsoids,
                                       std::span<const std::uint32_t> candidates) {
    const Pyramid pyramid = pyramidOf(camera, rectangle);
    std::vector<std::uint32_t> seen;
    for (const std::uint32_t k : candidates) {
        const SeenEllipsoid& each = ellipsoids[k];
        if (meetsCone(each, pyramid) && countsSomewhere(each) && meetsSides(each, pyramid)) seen.push_back(k);
    }
    return seen;
}

} // namespace pointrt::test
