// SPDX-License-Identifier: Apache-2.0
// The instances of a ray-cast scene from the paths it is opened with.
#pragma once

#include <string>
#include <vector>

#include "runtime/cast/cast_instance.h"

namespace pointrt {

/// Each path is a .pro, a tile set or a scene file (TOML), whose instances are numbered consecutively. Reads sets and
/// checks the headers of their original tiles against them. Does not open other files: their boxes are set when they
/// are loaded. Throws Error kBadUsage without paths or with more than MAX_CLIP_PLANES planes of clips, kBadInput if a
/// scene file, set or tile is invalid.
/// @param clips applied in addition to those of scene files, to all instances but those that scene files exempt
/// @param filters hide splats, besides those that the filters of these files hide
InstanceList describeInstances(const std::vector<std::string>& paths, const std::vector<ClipDescription>& clips = {},
                               const std::vector<FilterDescription>& filters = {});

} // namespace pointrt
