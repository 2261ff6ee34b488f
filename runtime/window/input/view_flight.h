// SPDX-License-Identifier: Apache-2.0
// From one view to another without a jump.
#pragma once

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// Times are in seconds of any one clock.
struct ViewFlight {
    ViewCamera from, to;
    double start_s = 0;
};

constexpr double kFlight_s = 0.3;

/// The view at time_s: level all the way, slow at both ends; `to` itself, to the bit, from kFlight_s after the start.
/// It has to's axis and projection at once; what is at the pivot keeps its size where the projection changes.
ViewCamera viewAt(const ViewFlight& flight, double time_s);
bool isFinished(const ViewFlight& flight, double time_s);

} // namespace pointrt
