// SPDX-License-Identifier: Apache-2.0
// A camera that moves smoothly through key views.
#pragma once

#include <span>

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// The camera at a place of the path: keys[i] exactly at i, and between two keys on a Catmull-Rom spline of eye and
/// directions, so that it neither stops nor turns sharply at a key. Fields of view and heights of parallel projection
/// change steadily; between keys of different projections, the nearer key's projection is used.
/// @param keys at least one, with orthonormal axes
/// @param at from 0 to keys.size() - 1
Camera cameraOnPath(std::span<const Camera> keys, double at);

} // namespace pointrt
