// SPDX-License-Identifier: Apache-2.0
// Default colours of scans without colours.
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

/// What kind of place a scene of scans shows. If it has no sample, an object.
PlaceKind placeKindOf(const DeviceScene& scene, const SceneSample& sample, Vec3 up);

/// How scans without colours are coloured by default. Sites (wide ground) by height, which shows buildings and trees
/// best. Other scans by intensity if it varies; else interiors, and objects from surveying instruments (with returns,
/// classes or the like), by height. None for scans with colours, and for other objects, which then look like clay.
/// @param up unit length
std::optional<DefaultColors> defaultColors(const DeviceScene& scene, const SceneSample& sample, Vec3 up);

/// Throws Error kBadUsage for an option that needs colours by value if color_by selects no value.
/// @param option null: no such option was given
void requireColored(const char* option, const std::string& color_by);

} // namespace pointrt
