// SPDX-License-Identifier: Apache-2.0
// The instances of a ray-cast scene from the paths it is opened with.
#pragma once

#include <string>
#include <vector>

#include "runtime/cast/cast_instance.h"

namespace pointrt {

/// Each path is a .pro, a tile set or a scene file (TOML), whose instances are numbered consecutively. Reads sets and
/// checks the headers of their original tiles against them. Does not open other files: their boxes are set when they
/// are loaded. Throws Error kBadUsage without paths, kBadInput if a scene file, set or tile is invalid.
InstanceList describeInstances(const std::vector<std::string>& paths);

} // namespace pointrt
