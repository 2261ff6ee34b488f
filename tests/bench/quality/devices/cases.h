// SPDX-License-Identifier: Apache-2.0
// Which device looked at what: the rows of the bench.
#pragma once

#include <functional>

#include "tests/bench/quality/devices/devices.h"
#include "tests/bench/quality/raw/camera.h"

namespace pointrt::quality {

struct DeviceCase {
    std::string device, subject;
    bool held_out = false; ///< not to be looked at while tuning
    /// In the frame that the scan's file has. data: folder of the meshes.
    std::function<World(const std::string& data)> world;
    /// Writes the scan below the folder and returns its path.
    std::function<std::string(const WorldTracing& world, const std::string& folder)> scan;
    std::vector<Pinhole> cameras;
    double depth_tolerance =
        0;                 ///< metres along the ray: three standard deviations of the device, about, or its spacing
    double seen_reach = 0; ///< metres: truth this near to a sample was scanned; some spacings

    std::string name() const { return device + "_" + subject; }
};

/// Two of each device, one of them held out.
std::vector<DeviceCase> deviceCases();

} // namespace pointrt::quality
