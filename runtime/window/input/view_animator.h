// SPDX-License-Identifier: Apache-2.0
// The camera as it goes on by itself: flights from view to view, and keys that are held.
#pragma once

#include <optional>

#include "runtime/window/input/view_flight.h"

namespace pointrt {

/// Times are in seconds of any one clock.
class ViewAnimator {
public:
    /// Where to go home to.
    ViewCamera home;

    /// What goes by itself ends: the camera was put elsewhere.
    void stop() { flight_.reset(); }
    void flyTo(const ViewCamera& from, const ViewCamera& to, double now_s) { flight_ = ViewFlight{from, to, now_s}; }
    /// From now on: x right, y up, z ahead, each -1, 0 or 1.
    void flyAlong(Vec3 direction) { direction_ = direction; }
    bool moves() const { return flight_ || length(direction_) > 0; }
    bool isInFlight() const { return flight_.has_value(); }

    /// The camera now_s, seconds after it was at camera.
    ViewCamera advanced(const ViewCamera& camera, double now_s, double seconds);

private:
    std::optional<ViewFlight> flight_;
    Vec3 direction_;
};

} // namespace pointrt
