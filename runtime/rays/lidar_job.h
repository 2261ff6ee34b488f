// SPDX-License-Identifier: Apache-2.0
// pointrt-rays lidar: from a simulated scanner to a file of points, block by block.
#pragma once

namespace pointrt {

/// Memory does not grow with the number of pulses. Throws Error with one line; then no output is there that was not.
/// @param argv from "lidar" on
int lidarCommand(int argc, const char* const* argv);

} // namespace pointrt
