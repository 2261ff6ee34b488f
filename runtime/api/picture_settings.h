// SPDX-License-Identifier: Apache-2.0
// Converts a caller's settings to the options of pointrt-view.
#pragma once

#include "pointrt/render.hpp"
#include "runtime/session/options.h"

namespace pointrt {

struct PictureOptions {
    Options options;
    std::optional<Vec3> staged_for; ///< SceneDescription::staged_for
};

/// Throws Error kBadUsage "NAME: reason" for unknown names, settings that pictures in memory do not support, and
/// invalid values.
PictureOptions pictureOptions(const PictureSettings& settings);

} // namespace pointrt
