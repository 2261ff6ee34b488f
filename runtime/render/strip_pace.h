// SPDX-License-Identifier: Apache-2.0
// How many rows to trace in one go, so that a frame can be broken off soon, whatever its rays meet.
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"

namespace pointrt {

/// Splats that a cell lists, in the scan where those are most: 15 to 40 in scans of surfaces, thousands where radii are
/// many times the points' distance.
double splatsPerCell(const DeviceScene& scene);

/// Of one scene. What strips took is believed for those that follow; what none has met yet, by how crowded cells are.
class StripPace {
public:
    explicit StripPace(double splats_per_cell);

    /// Rows of so many pixels that take about a second, 1 to most.
    std::uint32_t rowsFor(std::uint32_t width, std::uint32_t most) const;
    /// A sample of each of so many pixels has taken that long.
    void learn(std::uint64_t pixels, double seconds);

private:
    double least_, seconds_; ///< of a pixel: for all that is known of the scene, and as the last strips were
};

} // namespace pointrt
