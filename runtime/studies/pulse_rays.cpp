// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/pulse_rays.h"

#include <algorithm>
#include <iterator>

namespace pointrt {

PulseRayGenerator::PulseRayGenerator(const LidarSensor& sensor, const LidarRun& run)
    : pattern_(sensor.pattern), path_(run.trajectory), footprint_(sensor.divergence_mrad, sensor.rays),
      random_(run.seed), start_s_(run.start_s.value_or(run.trajectory.front().time)) {}

FiredPulse PulseRayGenerator::pulse(std::uint64_t number) const {
    const LidarPulse fired = pulseOf(pattern_, number);
    const double time = start_s_ + fired.delay_s;
    const ScannerPose pose = path_.at(time);
    return {number, time, pose.position, normalize(pose.rotated(fired.direction)), fired.ring, fired.scan_angle_deg};
}

void PulseRayGenerator::rays(const FiredPulse& pulse, std::span<double> numbers) const {
    const double start = footprint_.size() > 1 ? random_.uniform(pulse.number, LidarDraw::kFootprint) : 0;
    const BeamFootprint::Around around(pulse.axis, start);
    for (std::size_t i = 0; i < footprint_.size(); ++i) {
        const Vec3 origin = pulse.origin, direction = footprint_.ray(around, i);
        const double row[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z};
        std::copy(std::begin(row), std::end(row), numbers.begin() + static_cast<std::ptrdiff_t>(6 * i));
    }
}

} // namespace pointrt
