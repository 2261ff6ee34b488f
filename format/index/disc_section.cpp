// SPDX-License-Identifier: Apache-2.0
#include "format/index/disc_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Smaller components of normals are skipped: dividing by them would amplify rounding beyond the slack of cubes, 1/1000
/// of their edge. Results without them are still conservative.
constexpr float kMinComponent = 1.0f / 64;
/// For the same reason, discs with a radius of more than this many half edges are treated as planes.
constexpr float kLargestDisc = 32;

/// Vector from the disc's centre to the point of the cube closest to centre - shift * normal.
Vector toNearest(const PlacedDisc& disc, float shift, float half) {
    Vector to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float below = disc.center[axis] - shift * disc.normal[axis];
        to[axis] = std::clamp(below, -half, half) - disc.center[axis];
    }
    return to;
}

/// A shift, and the height of that point of the cube above the disc's plane, which decreases with the shift.
struct Shift {
    float shift, height;
};

/// The two shifts, on either side of height 0, at which clamping of a coordinate starts or ends; between them the
/// height is linear.
struct Bracket {
    Shift above{-kInfinity, kInfinity}, below{kInfinity, -kInfinity};

    void add(const PlacedDisc& disc, float shift, float half) {
        const float height = dot(disc.normal, toNearest(disc, shift, half));
        if (height >= 0 && shift > above.shift) above = {shift, height};
        if (height <= 0 && shift < below.shift) below = {shift, height};
    }
    bool isClosed() const { return above.shift > -kInfinity && below.shift < kInfinity; }
    /// The shift with height 0.
    float root() const {
        const float span = above.height - below.height;
        return span > 0 ? above.shift + (below.shift - above.shift) * (above.height / span) : above.shift;
    }
};

/// Upper bound of the extent of the plane's section of the cube from the disc's centre along a vector in the plane. By
/// weak duality any multiple of the normal may be added to the vector; the best one makes a component 0.
float reachOfSection(const PlacedDisc& disc, const Vector& along, float half) {
    float reach = kInfinity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::fabs(disc.normal[axis]) < kMinComponent) continue;
        const float multiple = along[axis] / disc.normal[axis];
        float sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float part = along[k] - multiple * disc.normal[k];
            sum += half * std::fabs(part) - part * disc.center[k];
        }
        reach = std::min(reach, sum);
    }
    return reach;
}

} // namespace

PlacedDisc placedIn(const CellDisc& disc, const CellBox& box) {
    PlacedDisc placed{disc.center, disc.normal, disc.radius};
    for (std::size_t axis = 0; axis < 3; ++axis) placed.center[axis] -= box.middle[axis];
    return placed;
}

bool overlapsCube(const PlacedDisc& disc, float half) {
    if (disc.radius > kLargestDisc * half) return true;
    Bracket bracket;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::fabs(disc.normal[axis]) < kMinComponent) continue;
        for (const float side : {-half, half}) bracket.add(disc, (disc.center[axis] - side) / disc.normal[axis], half);
    }
    if (!bracket.isClosed()) return true;
    const float shift = bracket.root();
    const Vector to = toNearest(disc, shift, half);
    // for any shift, the minimum of |to|^2 + 2 shift height over the cube is a lower bound for points in the plane
    return dot(to, to) + 2 * shift * dot(disc.normal, to) <= disc.radius * disc.radius;
}

float reachInCube(const PlacedDisc& disc, const Vector& along, float half) {
    if (disc.radius > kLargestDisc * half) return disc.radius;
    return std::min(disc.radius, reachOfSection(disc, along, half));
}

} // namespace pointrt
