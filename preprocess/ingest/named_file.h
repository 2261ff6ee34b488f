// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are named inside other files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pointrt {

/// The path of a file that a file in the folder names, or nullopt if it lies outside the folder: an untrusted input
/// must not expose other files of this machine, through any path, in the scene or in a message.
std::optional<std::filesystem::path> pathInFolder(const std::filesystem::path& folder, const std::string& name);

} // namespace pointrt
