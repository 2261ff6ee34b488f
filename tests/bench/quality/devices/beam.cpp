// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/devices/beam.h"

#include <algorithm>
#include <numeric>

namespace pointrt::quality {

std::vector<Echo> echoesOf(const WorldTracing& world, const Beam& beam, const Vec3d& origin, const Vec3d& direction,
                           double longest) {
    const Vec3d u = direction.unitOrthogonal(), v = direction.cross(u);
    const double share = 1.0 / beam.probes();
    std::vector<Echo> echoes;
    for (int ring = 0; ring <= beam.rings; ++ring)
        for (int i = 0; i < std::max(1, 6 * ring); ++i) {
            // radii such that each probe represents the same area of the cross-section
            const double out = beam.rings == 0 ? 0 : static_cast<double>(ring) / (beam.rings + 0.5);
            const double around = 2 * std::numbers::pi * i / std::max(1, 6 * ring);
            const Vec3d aside = out * (std::cos(around) * u + std::sin(around) * v);
            const Vec3d along = (direction + beam.half_divergence * aside).normalized();
            const auto hit = world.firstHit(origin + beam.exit_radius * aside, along);
            if (hit && hit->range <= longest) echoes.push_back({hit->range, share * hit->cosine});
        }
    std::sort(echoes.begin(), echoes.end(), [](const Echo& a, const Echo& b) { return a.range < b.range; });
    return echoes;
}

std::vector<Echo> grouped(const std::vector<Echo>& echoes, double gap) {
    std::vector<Echo> groups;
    double last = 0;
    for (const Echo& echo : echoes) {
        if (groups.empty() || echo.range - last > gap) groups.push_back({0, 0});
        Echo& group = groups.back();
        const double power = group.power + echo.power;
        if (power > 0) group.range += (echo.range - group.range) * echo.power / power;
        group.power = power;
        last = echo.range;
    }
    return groups;
}

double totalPower(const std::vector<Echo>& echoes) {
    return std::accumulate(echoes.begin(), echoes.end(), 0.0,
                           [](double sum, const Echo& echo) { return sum + echo.power; });
}

} // namespace pointrt::quality
