// SPDX-License-Identifier: Apache-2.0
// Smooth transitions between views.
#pragma once

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// Times in seconds of any steady clock.
struct ViewFlight {
    ViewCamera from, to;
    double start_s = 0;
};

constexpr double kFlight_s = 0.3;

/// The view at time_s: level throughout, eased at both ends, and exactly `to` once kFlight_s has passed since the
/// start. Has the axis and projection of `to` from the beginning; if the projection changes, objects at the pivot keep
/// their size.
ViewCamera viewAt(const ViewFlight& flight, double time_s);
bool isFinished(const ViewFlight& flight, double time_s);

} // namespace pointrt
