// SPDX-License-Identifier: Apache-2.0
// pointrt-rays lidar: simulates a laser scanner and writes its points, block by block.
#pragma once

namespace pointrt {

/// Memory does not grow with the number of pulses. Throws Error with a one-line message, and then leaves no new output
/// file.
/// @param argv from "lidar" on
int lidarCommand(int argc, const char* const* argv);

} // namespace pointrt
