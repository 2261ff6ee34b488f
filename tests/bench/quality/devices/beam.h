// SPDX-License-Identifier: Apache-2.0
// A laser beam that is not a line: what its cross-section meets, and what a receiver makes of it.
#pragma once

#include "tests/bench/quality/devices/random.h"
#include "tests/bench/quality/devices/world.h"

namespace pointrt::quality {

/// A part of the light that came back.
struct Echo {
    double range;
    double power; ///< share of the beam's light that came back, 1 from a surface at a right angle
};

/// A cone about a ray.
struct Beam {
    double exit_radius = 0;     ///< metres, where it leaves
    double half_divergence = 0; ///< radians, of the cone's edge
    int rings = 1;              ///< of probes round the one in the middle, six times their number on each
    double radiusAt(double range) const { return exit_radius + range * half_divergence; }
    int probes() const { return 1 + 3 * rings * (rings + 1); }
};

/// Lambert's law for each probe of the cross-section, all of the same light: nearest echo first.
/// direction: unit length. longest: nothing comes back from further.
std::vector<Echo> echoesOf(const WorldTracing& world, const Beam& beam, const Vec3d& origin, const Vec3d& direction,
                           double longest);

/// Echoes closer to the one before than gap are one: their mean, weighted by power, and their powers' sum.
std::vector<Echo> grouped(const std::vector<Echo>& echoes, double gap);

double totalPower(const std::vector<Echo>& echoes);

} // namespace pointrt::quality
