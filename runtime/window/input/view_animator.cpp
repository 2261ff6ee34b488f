// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/view_animator.h"

#include <algorithm>

namespace pointrt {
namespace {

/// Limit for slow frames, so that the camera does not jump.
constexpr double kMaxSeconds = 0.1;

} // namespace

ViewCamera ViewAnimator::advanced(const ViewCamera& camera, double now_s, double seconds) {
    ViewCamera view = camera;
    if (flight_) {
        view = viewAt(*flight_, now_s);
        if (isFinished(*flight_, now_s)) flight_.reset();
    }
    if (length(direction_) > 0) view = flown(view, direction_, std::min(seconds, kMaxSeconds));
    return view;
}

} // namespace pointrt
