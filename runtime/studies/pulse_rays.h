// SPDX-License-Identifier: Apache-2.0
// The rays of each pulse of a simulated scanner.
#pragma once

#include <cstdint>
#include <span>

#include "pointrt/lidar.hpp"
#include "runtime/studies/beam_footprint.h"
#include "runtime/studies/pattern.h"
#include "runtime/studies/philox.h"
#include "runtime/studies/scanner_path.h"

namespace pointrt {

/// A fired pulse, in the scan's coordinates.
struct FiredPulse {
    std::uint64_t number = 0;
    double time = 0;
    Vec3 origin, axis;
    std::uint16_t ring = 0;
    float scan_angle_deg = 0;
};

/// Computes the pulses of a run and their rays. Thread-safe.
class PulseRayGenerator {
public:
    /// sensor and run are valid (sensor_check.h).
    PulseRayGenerator(const LidarSensor& sensor, const LidarRun& run);

    std::size_t raysPerPulse() const { return footprint_.size(); }
    FiredPulse pulse(std::uint64_t number) const;
    /// Writes the raysPerPulse() rays of a pulse, six numbers for each.
    void rays(const FiredPulse& pulse, std::span<double> numbers) const;

private:
    const LidarPattern& pattern_;
    ScannerPath path_;
    BeamFootprint footprint_;
    LidarRandom random_;
    double start_s_;
};

} // namespace pointrt
