// SPDX-License-Identifier: Apache-2.0
// Files and folders that swap their names.
#pragma once

#include <string>

namespace pointrt {

/// Gives each of two files or folders the other's name, at once. False, with errno, if that fails; EINVAL or ENOSYS if
/// the file system or the system cannot.
bool swapNames(const std::string& one, const std::string& other);

/// Gives a folder another name. False, with errno, if that fails; EEXIST or ENOTEMPTY if the name is taken.
bool renameFolder(const std::string& folder, const std::string& name);

} // namespace pointrt
