// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/aim.h"

#include <algorithm>
#include <iterator>

namespace pointrt {

LidarAim::LidarAim(const LidarSensor& sensor, const LidarRun& run)
    : pattern_(sensor.pattern), path_(run.trajectory), spot_(sensor.divergence_mrad, sensor.rays), random_(run.seed),
      start_s_(run.start_s.value_or(run.trajectory.front().time)) {}

LidarShot LidarAim::shot(std::uint64_t number) const {
    const LidarPulse pulse = pulseOf(pattern_, number);
    const double time = start_s_ + pulse.delay_s;
    const LidarStand stand = path_.at(time);
    return {number, time, stand.position, normalize(stand.turned(pulse.direction)), pulse.ring, pulse.scan_angle_deg};
}

void LidarAim::rays(const LidarShot& shot, std::span<double> numbers) const {
    const double turn = spot_.size() > 1 ? random_.uniform(shot.number, LidarChance::kTurn) : 0;
    const LidarSpot::Around around(shot.axis, turn);
    for (std::size_t i = 0; i < spot_.size(); ++i) {
        const Vec3 origin = shot.origin, direction = spot_.ray(around, i);
        const double row[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z};
        std::copy(std::begin(row), std::end(row), numbers.begin() + static_cast<std::ptrdiff_t>(6 * i));
    }
}

} // namespace pointrt
