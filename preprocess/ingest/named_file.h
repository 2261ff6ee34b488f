// SPDX-License-Identifier: GPL-3.0-or-later
// Files that belong to another file: named by it, or in a folder beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// The path of a file that a file in the folder names, or nullopt if it lies outside the folder: an untrusted input
/// must not expose other files of this machine, through any path, in the scene or in a message.
std::optional<std::filesystem::path> pathInFolder(const std::filesystem::path& folder, const std::string& name);

/// The files of a folder, in no order, without its subfolders; none if it cannot be listed.
std::vector<std::string> filesOfFolder(const std::filesystem::path& folder);

} // namespace pointrt
