// SPDX-License-Identifier: Apache-2.0
// Rows to trace per submission, so that a frame can be aborted soon, and a desktop on the same GPU stays alive,
// whatever the scene.
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"

namespace pointrt {

/// Mean number of splats that a cell lists, for the scan where it is largest: 15 to 40 in scans of surfaces, thousands
/// if radii are many times the spacing of the points.
double splatsPerCell(const DeviceScene& scene);

/// Predicts the time of strips of a scene from the earlier ones, and at first from the number of splats per cell.
class StripPace {
public:
    StripPace(double splats_per_cell, VkPhysicalDeviceType device);

    /// Number of rows of `width` pixels that take about as long as a strip may: 1 to `most`.
    std::uint32_t rowsFor(std::uint32_t width, std::uint32_t most) const;
    /// Reports the time that one sample of each of `pixels` pixels took.
    void update(std::uint64_t pixels, double seconds);

private:
    double strip_seconds_, least_, seconds_; ///< time of a strip; per pixel: lower bound for the scene, and as measured
};

} // namespace pointrt
