// SPDX-License-Identifier: Apache-2.0
#include "format/index/cell_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "format/index/disc_section.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

/// A disc with a radius above this many cell edges is replaced by one of this radius with the same rim near the cell:
/// in the cell the rims are at most 3/4 / (2 * 8) edges apart, less than 1/100 of the radius.
constexpr float kLargestCodedRadius = 8;

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector sum(const Vector& a, float scale, const Vector& b) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}

/// A disc relative to the middle of the cell, in cell edges; its radius is at most kLargestCodedRadius. A ball keeps
/// any radius, because a smaller one would bend its surface more.
struct Place {
    Vector center;
    float radius;
};

Place placeIn(const CellDisc& disc, const CellBox& box) {
    const float edges = 0.5f / box.half_edge;
    Place place{{}, disc.radius * edges};
    for (std::size_t axis = 0; axis < 3; ++axis) place.center[axis] = (disc.center[axis] - box.middle[axis]) * edges;
    if (place.radius <= kLargestCodedRadius || disc.isBall()) return place;
    // offset of the centre from the point of the plane closest to the middle of the cell
    const float height = dot(place.center, disc.normal);
    const Vector away = sum(place.center, -height, disc.normal);
    const float distance = std::sqrt(dot(away, away));
    const float shorter =
        distance > 0 ? std::max(0.0f, distance - (place.radius - kLargestCodedRadius)) / distance : 0.0f;
    return {sum(sum(Vector{}, shorter, away), height, disc.normal), kLargestCodedRadius};
}

/// Sum of the normals, flipped to one side; 0 if all are balls.
Vector meanNormal(std::span<const CellDisc* const> discs) {
    Vector mean = discs[0]->normal;
    for (const CellDisc* disc : discs.subspan(1))
        mean = sum(mean, dot(mean, disc->normal) < 0 ? -1.0f : 1.0f, disc->normal);
    return mean;
}

/// Sum of the offsets of balls from the middle of the cell: most balls reach into it from one side.
Vector meanOffset(std::span<const CellDisc* const> balls, const CellBox& box) {
    Vector mean{};
    for (const CellDisc* ball : balls) mean = sum(mean, 1.0f, sum(ball->center, -1.0f, box.middle));
    return mean;
}

std::uint32_t bits(std::int32_t value, std::uint32_t count) {
    return static_cast<std::uint32_t>(value) & ((1u << count) - 1);
}

constexpr float kMaxHalf = 65504;

/// Rounds down to one of a few values that are half floats, so that lists which differ in a disc or two, such as those
/// of pruned and unpruned files, get the same value.
float sixteenthOctaveBelow(float value) {
    const float step = std::ldexp(0.0625f, std::ilogb(value));
    return std::floor(value / step) * step;
}

/// Range of heights along a vector from the middle of the cell, in lengths of the vector.
struct Heights {
    float least = std::numeric_limits<float>::infinity(), most = -least;
};

/// Extends the range of heights to include the part of the ball that may be in the cell.
void widenForBall(Heights& heights, const CellDisc& ball, const Vector& normal, const CellBox& box) {
    const float middle = dot(normal, placedIn(ball, box).center), reach = ball.radius * std::sqrt(dot(normal, normal));
    const float corner =
        (box.half_edge + box.slack) * (std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]));
    heights.least = std::min(heights.least, std::max(middle - reach, -corner));
    heights.most = std::max(heights.most, std::min(middle + reach, corner));
}

/// Extends the range of heights to include the part of the disc that is in the cell.
void widen(Heights& heights, const CellDisc& disc, const Vector& normal, const CellBox& box) {
    if (disc.isBall()) return widenForBall(heights, disc, normal, box);
    const PlacedDisc placed = placedIn(disc, box);
    const float middle = dot(normal, placed.center), half = box.half_edge + box.slack;
    // not from 1 - cos^2, which cancels if the disc is nearly parallel to the planes
    const Vector axis = cross(normal, disc.normal);
    const float sine = std::sqrt(dot(axis, axis)), reach = disc.radius * sine;
    if (heights.least <= middle - reach && middle + reach <= heights.most) return;
    Vector up = cross(disc.normal, axis);
    for (float& component : up) component /= std::max(sine, std::numeric_limits<float>::min());
    const Vector down{-up[0], -up[1], -up[2]};
    heights.least = std::min(heights.least, middle - sine * reachInCube(placed, down, half));
    heights.most = std::max(heights.most, middle + sine * reachInCube(placed, up, half));
}

/// The upper bits of the float, rounded to nearest.
std::uint32_t radiusCode(float squared) {
    const std::uint32_t rounded = std::bit_cast<std::uint32_t>(squared) + (1u << (PRO_NEAR_RADIUS_SHIFT - 1));
    return rounded <= PRO_NEAR_RADIUS_BIAS ? 0u : (rounded - PRO_NEAR_RADIUS_BIAS) >> PRO_NEAR_RADIUS_SHIFT;
}

/// Like std::lround, which compilers do not inline.
std::int32_t rounded(float value) { return static_cast<std::int32_t>(value + (value < 0 ? -0.5f : 0.5f)); }

/// Rounds a position to one of the eight lattice points around it, preferring those close to the disc's plane: an error
/// across the plane changes which of two discs a ray hits first, but one in the plane only moves the rim.
std::array<std::int32_t, 3> positionCodes(const Vector& position, const Vector& normal) {
    // cost of a squared distance across the plane, relative to one in it
    constexpr float kHeightWeight = 16;
    std::array<std::int32_t, 3> best{};
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        std::array<std::int32_t, 3> codes;
        Vector off;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            codes[axis] = std::clamp(static_cast<std::int32_t>(std::floor(position[axis])) +
                                         static_cast<std::int32_t>(corner >> axis & 1),
                                     -PRO_NEAR_POSITION_MAX, PRO_NEAR_POSITION_MAX);
            off[axis] = static_cast<float>(codes[axis]) - position[axis];
        }
        const float height = dot(off, normal), cost = dot(off, off) + kHeightWeight * height * height;
        if (cost < least) best = codes, least = cost;
    }
    return best;
}

/// @param n 0 for a ball
/// @param codes position codes per cell edge
void appendNear(const Place& place, const Vector& n, float codes, std::vector<std::uint32_t>& near) {
    const bool ball = n == Vector{};
    const float largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    const float normal_codes = ball ? 0.0f : PRO_NEAR_NORMAL_MAX / largest;
    const std::array<std::int32_t, 3> center = positionCodes(sum(Vector{}, codes, place.center), n);
    std::uint32_t position = 0, normal = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        position = position << PRO_NEAR_POSITION_BITS | bits(center[axis], PRO_NEAR_POSITION_BITS);
        normal = normal << PRO_NEAR_NORMAL_BITS | bits(rounded(n[axis] * normal_codes), PRO_NEAR_NORMAL_BITS);
    }
    const std::uint32_t coded = radiusCode(place.radius * codes * place.radius * codes);
    const std::uint32_t radius = ball ? std::max(coded, 1u) : coded; // a ball with radius code 0 would mean no splat
    near.push_back(position << PRO_NEAR_RADIUS_HIGH_BITS | radius >> PRO_NEAR_RADIUS_LOW_BITS);
    near.push_back(normal << PRO_NEAR_RADIUS_LOW_BITS | bits(radius, PRO_NEAR_RADIUS_LOW_BITS));
}

/// Upper bound of the places' coordinates, in edges. Discs overlap the cell, so the largest radius gives a bound, which
/// is the same for lists that differ in another disc.
float reachOf(std::span<const Place> places, const CellBox& box) {
    float radius = 0;
    for (const Place& place : places) radius = std::max(radius, place.radius);
    const float side = (box.half_edge + box.slack) * (0.5f / box.half_edge), corner = side * std::sqrt(3.0f);
    return radius + (radius < kLargestCodedRadius ? side : corner); // placeIn moves the centres of larger discs
}

} // namespace

std::uint32_t toHalf(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000u;
    const int exponent = static_cast<int>(bits >> 23 & 0xFF) - 127;
    if (exponent < -14) return sign | static_cast<std::uint32_t>(std::lround(std::fabs(value) * 0x1p24f));
    return sign | static_cast<std::uint32_t>(exponent + 15) << 10 | (bits >> 13 & 0x3FFu);
}

std::uint32_t slabWord(std::span<const CellDisc* const> discs, const CellBox& box) {
    const Vector normals = meanNormal(discs), mean = normals == Vector{} ? meanOffset(discs, box) : normals;
    const float length = std::sqrt(dot(mean, mean));
    std::array<std::int32_t, 3> codes{};
    Vector normal{};
    for (std::size_t axis = 0; axis < 3 && length > 0; ++axis) {
        codes[axis] = static_cast<std::int32_t>(std::lround(mean[axis] / length * PRO_SLAB_NORMAL_MAX));
        normal[axis] = static_cast<float>(codes[axis]) / PRO_SLAB_NORMAL_MAX;
    }
    const float edges = 0.5f / box.half_edge;
    Heights heights;
    for (const CellDisc* disc : discs) widen(heights, *disc, normal, box);
    const float lo = (heights.least - box.slack) * edges, hi = (heights.most + box.slack) * edges;
    static constexpr float kMax = PRO_SLAB_HEIGHT_MAX; // one edge: beyond the corners of a cell with a slack of
                                                       // 1/16 edge (kMinHalfEdge, kDeepest)
    const auto code = [](float height) { return static_cast<std::int32_t>(std::clamp(height, -kMax, kMax)); };
    std::uint32_t word = bits(code(std::ceil(hi * PRO_SLAB_STEPS)), PRO_SLAB_HEIGHT_BITS);
    word = word << PRO_SLAB_HEIGHT_BITS | bits(code(std::floor(lo * PRO_SLAB_STEPS)), PRO_SLAB_HEIGHT_BITS);
    for (std::size_t axis = 3; axis-- > 0;)
        word = word << PRO_SLAB_NORMAL_BITS | bits(codes[axis], PRO_SLAB_NORMAL_BITS);
    return word;
}

float encodeNear(std::span<const CellDisc* const> discs, const CellBox& box, std::vector<std::uint32_t>& near) {
    std::vector<Place> places;
    places.reserve(discs.size());
    for (const CellDisc* disc : discs) places.push_back(placeIn(*disc, box));
    const float codes = sixteenthOctaveBelow(std::min(kMaxHalf, PRO_NEAR_POSITION_MAX / reachOf(places, box)));
    for (std::size_t k = 0; k < discs.size(); ++k) appendNear(places[k], discs[k]->normal, codes, near);
    return codes;
}

} // namespace pointrt
