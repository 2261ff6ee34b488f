// SPDX-License-Identifier: Apache-2.0
// Folders under paths of any length: on Windows, std::filesystem cannot list those with a path of more than 260
// characters.
#pragma once

#include <string>
#include <system_error>
#include <vector>

namespace pointrt {

/// The paths of everything in a folder, in no particular order. If it cannot be listed, `failure` has the reason.
std::vector<std::string> listFolder(const std::string& folder, std::error_code& failure);

/// Deletes a file, or a folder with all its contents; does nothing if path does not exist. `failure` has the reason if
/// something remains.
void removeAll(const std::string& path, std::error_code& failure);

} // namespace pointrt
