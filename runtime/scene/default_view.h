// SPDX-License-Identifier: Apache-2.0
// The default view of a scene.
#pragma once

#include <optional>

#include "runtime/scene/scene_sample.h"
#include "runtime/scene/standard_view.h"

namespace pointrt {

struct ViewChoice {
    Vec3 side;               ///< unit vector from the scene to the eye
    std::optional<Vec3> eye; ///< a fixed position: a scanner's, or one inside a room; none: outside the scene
    bool is_site = false;    ///< a site seen from above, whose sparse outskirts may be outside the picture
};

/// The side of a standard view. up: unit length
Vec3 sideOf(StandardView view, Vec3 up);
/// The up direction of a standard view's picture.
Vec3 upIn(StandardView view, Vec3 up);

/// The view that shows most of sample, which must have no strays:
///  - range images: from the single scanner, if everything lies in front of it: at its known position, or at the origin
///    of the file's coordinates if discs grow with their distance from there;
///  - rooms, mostly occluded from outside: from a position inside, a scanner's if known;
///  - walls without a ceiling: from above, so that the nearest wall does not hide what they enclose;
///  - sites, wide and flat or with horizontal ground: from above, slightly right of the front;
///  - all else: from the front, or from another side if that shows much more.
/// sample: not empty
ViewChoice chooseView(const SceneSample& sample, Vec3 up);

enum class PlaceKind { kObject, kRoom, kSite };
/// The kind of place that sample shows: an interior, ground wider than it is high, or anything else. sample: not empty,
/// without strays; up: unit length; is_surveyed: scanned by lidar or the like, so that anything wide is ground, even
/// under trees
PlaceKind placeKind(const SceneSample& sample, Vec3 up, bool is_surveyed);

/// The view from a scanner: the one that saw everything, or the one that shows most. None if no scanner's position is
/// known.
std::optional<ViewChoice> viewOfSensor(const SceneSample& sample, Vec3 up);

} // namespace pointrt
