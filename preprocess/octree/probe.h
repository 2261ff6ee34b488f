// SPDX-License-Identifier: GPL-3.0-or-later
// Probe rays: low-discrepancy numbers, points on discs, lines through boxes.
#pragma once

#include <array>
#include <cstdint>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

/// Low-discrepancy points in [0, 1)^5, well distributed for any prefix; different for each seed and leaf.
class ProbeSequence {
public:
    ProbeSequence(std::uint64_t seed, std::uint64_t leaf);
    std::array<float, 5> next();

private:
    std::array<double, 5> offsets_{};
};

/// Uniform on the disc, or on the surface of the ball, for u, v uniform in [0, 1).
Vec3f pointOnDisc(const Disc& disc, float u, float v);

/// Uniform over the sphere, including grazing directions, in which pruning by first hits opens cracks.
Vec3f sphereDirection(float u, float v);

/// Approximately the point in the box with the largest weight of the disc: that of least d^2 / r^2 + h^2 / s^2 with d
/// in the disc's plane, h across it and s = slab r.
Vec3f heaviestPoint(const Disc& disc, const Box& box, float slab);

/// Weight of the disc at the point: (1 - d^2/r^2)^2 (1 - h^2/s^2)^2.
float weightAt(const Disc& disc, const Vec3f& point, float slab);

bool contains(const Box& box, const Vec3f& point);

/// The part of a line inside a box.
struct Chord {
    Vec3f origin;    ///< entry point
    Vec3f direction; ///< unit length
    float length;

    Vec3f at(float t) const { return origin + t * direction; }
};

/// The chord through a point in the box.
Chord chordThrough(const Box& box, const Vec3f& point, const Vec3f& direction);

} // namespace pointrt
