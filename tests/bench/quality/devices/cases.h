// SPDX-License-Identifier: Apache-2.0
// The rows of the bench: devices and subjects.
#pragma once

#include <functional>

#include "tests/bench/quality/devices/devices.h"
#include "tests/bench/quality/raw/camera.h"

namespace pointrt::quality {

struct DeviceCase {
    std::string device, subject;
    bool held_out = false; ///< do not look at it while tuning
    /// The world in the frame of the scan's file. data: folder of the meshes.
    std::function<World(const std::string& data)> world;
    /// Writes the scan into the folder and returns its path.
    std::function<std::string(const WorldTracing& world, const std::string& folder)> scan;
    std::vector<Pinhole> cameras;
    double depth_tolerance = 0; ///< metres along the ray: about three standard deviations of the device, or its spacing
    double seen_reach = 0;      ///< metres: truth within this distance of a sample counts as scanned; some spacings

    std::string name() const { return device + "_" + subject; }
};

/// Two cases per device, one of them held out.
std::vector<DeviceCase> deviceCases();

} // namespace pointrt::quality
