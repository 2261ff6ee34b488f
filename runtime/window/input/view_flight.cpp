// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/view_flight.h"

#include <algorithm>
#include <cmath>

#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

double mixed(double from, double to, double share) { return from + (to - from) * share; }

/// Geometric interpolation: sizes in the picture change at a constant rate.
double mixedSize(double from, double to, double share) { return from * std::pow(to / from, share); }

Attitude mixedAttitude(const Attitude& from, const Attitude& to, Vec3 axis, double share) {
    const double angle = std::atan2(dot(cross(from.right, to.right), axis), dot(from.right, to.right));
    return {rotated(from.right, axis, angle * share), mixed(from.elevation, to.elevation, share)};
}

/// flight.from with the axis and projection of flight.to.
ViewCamera departure(const ViewFlight& flight) {
    const bool same_projection = (flight.from.ortho_height > 0) == (flight.to.ortho_height > 0);
    ViewCamera from = same_projection ? flight.from : orthoToggled(flight.from);
    from.up = flight.to.up;
    return from;
}

double eased(double share) { return share * share * (3 - 2 * share); }

} // namespace

bool isFinished(const ViewFlight& flight, double time_s) { return !(time_s < flight.start_s + kFlight_s); }

ViewCamera viewAt(const ViewFlight& flight, double time_s) {
    if (isFinished(flight, time_s)) return flight.to;
    const double share = eased(std::clamp((time_s - flight.start_s) / kFlight_s, 0.0, 1.0));
    const ViewCamera from = departure(flight);
    const ViewCamera& to = flight.to;
    ViewCamera view = to;
    view.fov_deg = mixed(from.fov_deg, to.fov_deg, share);
    view.pivot_offset = mixed(from.pivot_offset, to.pivot_offset, share);
    if (to.ortho_height > 0) view.ortho_height = mixedSize(from.ortho_height, to.ortho_height, share);
    return placed(view, from.pivot + (to.pivot - from.pivot) * share,
                  mixedSize(distanceToPivot(from), distanceToPivot(to), share),
                  mixedAttitude(attitudeOf(from), attitudeOf(to), normalize(to.up), share));
}

} // namespace pointrt
