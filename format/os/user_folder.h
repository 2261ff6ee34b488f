// SPDX-License-Identifier: Apache-2.0
// The user's folders for caches and state, by the XDG base directory specification;
// on Windows in %LOCALAPPDATA%\pointrt.
#pragma once

#include <string>

namespace pointrt {

/// $XDG_CACHE_HOME/pointrt, or ~/.cache/pointrt; pointrt\cache on Windows. Empty if the user has neither.
std::string userCacheFolder();

/// $XDG_STATE_HOME/pointrt, or ~/.local/state/pointrt; pointrt\state on Windows. Empty if the user has neither.
std::string userStateFolder();

/// Creates path and missing folders above it, accessible only to the user, as the specification requires. False if that
/// fails.
bool makePrivateFolder(const std::string& path);

} // namespace pointrt
