// SPDX-License-Identifier: Apache-2.0
// The side that a scene is seen from where nobody says it.
#pragma once

#include <optional>

#include "runtime/scene/scene_sample.h"
#include "runtime/scene/standard_view.h"

namespace pointrt {

struct ViewChoice {
    Vec3 side;               ///< unit, from what is seen to the eye
    std::optional<Vec3> eye; ///< where it has to stand: a camera's place, or one within a room
};

/// The direction of a view by its name. up: unit length
Vec3 sideOf(StandardView view, Vec3 up);
/// What is up in its picture.
Vec3 upIn(StandardView view, Vec3 up);

/// What shows most of sample, which has no strays:
///  - one scanner that saw all in front of it is where the eye stands;
///  - of a room, of which most is hidden from outside, a place within it, a scanner's where one is known;
///  - sites, wide and flat or with level ground, from above, a little to the right of the front;
///  - all else from the front, or from the side where much more was scanned.
/// sample: not empty
ViewChoice chooseView(const SceneSample& sample, Vec3 up);

/// From a scanner: the one that saw all, or the one with most before it. None where no scanner's place is known.
std::optional<ViewChoice> viewOfSensor(const SceneSample& sample, Vec3 up);

} // namespace pointrt
