// SPDX-License-Identifier: Apache-2.0
// A caller's words for settings, as what pointrt-view makes of its command line.
#pragma once

#include "pointrt/render.hpp"
#include "runtime/session/options.h"

namespace pointrt {

struct PictureOptions {
    Options options;
    std::optional<Vec3> staged_for; ///< SceneDescription::staged_for
};

/// Throws Error kBadUsage "NAME: reason" for names that are none, or not of pictures in memory, and for values that
/// they cannot have.
PictureOptions pictureOptions(const PictureSettings& settings);

} // namespace pointrt
