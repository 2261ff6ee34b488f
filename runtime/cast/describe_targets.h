// SPDX-License-Identifier: Apache-2.0
// From the names that a scene is opened by to its targets.
#pragma once

#include <string>
#include <vector>

#include "runtime/cast/target.h"

namespace pointrt {

/// Each path is a .pro, a tile set or a scene file (TOML), whose instances take the next numbers in their order. Sets
/// are read, and their original tiles held against what they say; other files are opened by who loads them, and have no
/// box yet. Throws Error kBadUsage without paths, kBadInput with one line for what is wrong with a scene file, a set or
/// a tile.
TargetList describeTargets(const std::vector<std::string>& paths);

} // namespace pointrt
