// SPDX-License-Identifier: Apache-2.0
// pointrt-info of a tile set.
#pragma once

#include <string>

namespace pointrt {

/// Both write to standard output, and return the exit code. Throw Error, also where set.json is wrong.
int printSet(const std::string& folder, bool json);

/// set.json, then every tile on all cores; findings in the tiles' order. quiet: not that there are none.
int verifySet(const std::string& folder, bool json, bool quiet);

} // namespace pointrt
