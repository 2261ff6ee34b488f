// SPDX-License-Identifier: Apache-2.0
// Files and folders that swap their names.
#pragma once

#include <string>

namespace pointrt {

/// Exchanges the names of two files or folders atomically. False, with errno, if that fails; EINVAL or ENOSYS if the
/// file system or the system does not support it.
bool swapNames(const std::string& one, const std::string& other);

/// Renames a folder. False, with errno, if that fails; EEXIST or ENOTEMPTY if the name is taken.
bool renameFolder(const std::string& folder, const std::string& name);

} // namespace pointrt
