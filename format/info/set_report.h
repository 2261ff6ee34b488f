// SPDX-License-Identifier: Apache-2.0
// pointrt-info for tile sets.
#pragma once

#include <string>

namespace pointrt {

/// Both write to standard output and return the exit code. They throw Error, also for an invalid set.json.
int printSet(const std::string& folder, bool json);

/// Verifies set.json, then every tile, on all cores. Lists findings in the order of tiles.
/// @param quiet print nothing if there are no findings
int verifySet(const std::string& folder, bool json, bool quiet);

} // namespace pointrt
