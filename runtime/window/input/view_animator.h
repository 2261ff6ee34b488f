// SPDX-License-Identifier: Apache-2.0
// Camera animation: flights between views, and flying while keys are held.
#pragma once

#include <optional>

#include "runtime/window/input/view_flight.h"

namespace pointrt {

/// Times in seconds of any steady clock.
class ViewAnimator {
public:
    /// Target of Action::kHome.
    ViewCamera home;

    /// Ends a flight, because the camera was moved.
    void stop() { flight_.reset(); }
    void flyTo(const ViewCamera& from, const ViewCamera& to, double now_s) { flight_ = ViewFlight{from, to, now_s}; }
    /// Sets the direction of flight: x right, y up, z forward, each -1, 0 or 1.
    void flyAlong(Vec3 direction) { direction_ = direction; }
    bool moves() const { return flight_ || length(direction_) > 0; }
    bool isInFlight() const { return flight_.has_value(); }

    /// The camera at now_s. camera: the camera `seconds` earlier.
    ViewCamera advanced(const ViewCamera& camera, double now_s, double seconds);

private:
    std::optional<ViewFlight> flight_;
    Vec3 direction_;
};

} // namespace pointrt
