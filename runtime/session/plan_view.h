// SPDX-License-Identifier: Apache-2.0
// Plans in true scale: the camera, the picture's size and its place on the map.
#pragma once

#include "runtime/scene/scene_description.h"
#include "runtime/session/options.h"

namespace pointrt {

/// With options.plan, sets the camera, size and background of a plan of all visible scans of the scene, and
/// options.place; also the scene's up, unless it has one. Pixels lie on multiples of their size, so that plans of equal
/// scale fit together. If z is up, x is east and y north. Otherwise x is east (y if x is vertical), and north is up x
/// east: -z if y is up. Throws Error kBadUsage if no axis is up, no scan is visible, or the picture would be too large;
/// kBadInput for an unreadable file.
void fillPlan(Options& options, SceneDescription& description);

} // namespace pointrt
