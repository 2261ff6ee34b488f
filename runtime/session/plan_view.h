// SPDX-License-Identifier: Apache-2.0
// Plans in true scale: the camera, the picture's size and its place on the map.
#pragma once

#include "runtime/session/options.h"

namespace pointrt {

/// With options.plan, sets the camera, size and background of a plan of options.scene, and options.place. Pixels lie on
/// multiples of their size, so that plans of equal scale fit together. Throws Error kBadUsage if the scene is not one
/// scan or tile set whose z is up, or the picture would be too large; kBadInput for an unreadable file.
void fillPlan(Options& options);

} // namespace pointrt
