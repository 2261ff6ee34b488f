// SPDX-License-Identifier: Apache-2.0
#include "format/index/disc_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Components of normals below are passed over: dividing by them would make more of rounding than cubes are taken
/// larger by, a thousandth of their edge. What is found without them is no less true.
constexpr float kMinComponent = 1.0f / 64;
/// For the same reason discs of more than so many half edges are taken for planes.
constexpr float kLargestRadius = 32;

/// From the disc's centre to the cube's point nearest to what lies shift normals below the centre.
Vector toNearest(const PlacedDisc& disc, float shift, float half) {
    Vector to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float below = disc.center[axis] - shift * disc.normal[axis];
        to[axis] = std::clamp(below, -half, half) - disc.center[axis];
    }
    return to;
}

/// A shift, and how high over the disc's plane the cube's nearest point then is: less the larger the shift.
struct Shift {
    float shift, height;
};

/// Between the shifts where a coordinate begins or ceases to be the cube's own, the height is linear: those around 0.
struct Around {
    Shift above{-kInfinity, kInfinity}, below{kInfinity, -kInfinity};

    void take(const PlacedDisc& disc, float shift, float half) {
        const float height = dot(disc.normal, toNearest(disc, shift, half));
        if (height >= 0 && shift > above.shift) above = {shift, height};
        if (height <= 0 && shift < below.shift) below = {shift, height};
    }
    bool isClosed() const { return above.shift > -kInfinity && below.shift < kInfinity; }
    /// Where the height is 0.
    float between() const {
        const float span = above.height - below.height;
        return span > 0 ? above.shift + (below.shift - above.shift) * (above.height / span) : above.shift;
    }
};

/// How far the plane's section of the cube reaches from the disc's centre along a vector in the plane, at most. By weak
/// duality any multiple of the normal may be added to the vector; the best one makes a component 0.
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

bool meetsCube(const PlacedDisc& disc, float half) {
    if (disc.radius > kLargestRadius * half) return true;
    Around around;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::fabs(disc.normal[axis]) < kMinComponent) continue;
        for (const float side : {-half, half}) around.take(disc, (disc.center[axis] - side) / disc.normal[axis], half);
    }
    if (!around.isClosed()) return true;
    const float shift = around.between();
    const Vector to = toNearest(disc, shift, half);
    // the least of |to|^2 + 2 shift height over the cube: no point of it in the plane is nearer, whatever the shift
    return dot(to, to) + 2 * shift * dot(disc.normal, to) <= disc.radius * disc.radius;
}

float reachInCube(const PlacedDisc& disc, const Vector& along, float half) {
    if (disc.radius > kLargestRadius * half) return disc.radius;
    return std::min(disc.radius, reachOfSection(disc, along, half));
}

} // namespace pointrt
