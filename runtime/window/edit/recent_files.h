// SPDX-License-Identifier: Apache-2.0
// Recently opened files, for the start page.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// Paths of files that still exist, the latest first.
/// @param folder userStateFolder() of user_folder.h
std::vector<std::string> recentFiles(const std::string& folder);

/// Puts path first. Does nothing if folder is "" or cannot be written, since the list is only a convenience.
void addRecentFile(const std::string& folder, const std::string& path);

} // namespace pointrt
