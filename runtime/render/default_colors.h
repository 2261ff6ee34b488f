// SPDX-License-Identifier: Apache-2.0
// Colours of scans without colour.
#pragma once

#include <optional>
#include <string>

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/default_view.h"
#include "runtime/scene/scene_sample.h"
#include "runtime/scene/value_range.h"

namespace pointrt {

struct DefaultColors {
    std::string color_by;
    std::optional<ValueRange> range;
};

/// What a scene of scans shows. Without a sample, an object.
PlaceKind placeKindOf(const DeviceScene& scene, const SceneSample& sample, Vec3 up);

/// How scans without colours are coloured by default. Sites, which are wide ground, by height, which shows
/// buildings and trees better than anything else. Other scans by intensity if that varies. Interiors without, and
/// objects of surveying instruments, which have returns, classes or the like, by height. None for scans with colours,
/// and for other objects, which look like clay.
/// @param up unit length
std::optional<DefaultColors> defaultColors(const DeviceScene& scene, const SceneSample& sample, Vec3 up);

} // namespace pointrt
