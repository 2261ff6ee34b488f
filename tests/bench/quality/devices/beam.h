// SPDX-License-Identifier: Apache-2.0
// Laser beams with divergence: echoes of the cross-section, and how a receiver separates them.
#pragma once

#include "tests/bench/quality/devices/random.h"
#include "tests/bench/quality/devices/world.h"

namespace pointrt::quality {

/// A part of the returned light.
struct Echo {
    double range;
    double power; ///< share of the beam's light that returned; 1 for a surface perpendicular to it
};

/// A cone around a ray.
struct Beam {
    double exit_radius = 0;     ///< metres, at the exit
    double half_divergence = 0; ///< radians, of the cone's edge
    int rings = 1;              ///< rings of probes around a central one; ring n has 6 n
    double radiusAt(double range) const { return exit_radius + range * half_divergence; }
    int probes() const { return 1 + 3 * rings * (rings + 1); }
};

/// Echoes of the probes by Lambert's law, nearest first; each probe has the same light. direction: unit length.
/// longest: maximum range.
std::vector<Echo> echoesOf(const WorldTracing& world, const Beam& beam, const Vec3d& origin, const Vec3d& direction,
                           double longest);

/// Merges echoes closer to the previous one than gap: the mean range, weighted by power, and the sum of powers.
std::vector<Echo> grouped(const std::vector<Echo>& echoes, double gap);

double totalPower(const std::vector<Echo>& echoes);

} // namespace pointrt::quality
