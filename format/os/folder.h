// SPDX-License-Identifier: Apache-2.0
// Folders under paths of any length: std::filesystem lists none on Windows whose path is longer than 260 characters.
#pragma once

#include <string>
#include <system_error>
#include <vector>

namespace pointrt {

/// The paths of what is in a folder, in no order. If it cannot be listed, `failure` has the reason.
std::vector<std::string> listFolder(const std::string& folder, std::error_code& failure);

/// Deletes a file, or a folder with all that is in it; nothing if there is no such file. `failure` has the reason if
/// something stays.
void removeAll(const std::string& path, std::error_code& failure);

} // namespace pointrt
