// SPDX-License-Identifier: Apache-2.0
// Folders for temporary files.
#pragma once

#include <string>

namespace pointrt {

/// Creates a new folder, accessible only to the user, where the system keeps temporary files. Empty if that fails.
std::string makeTemporaryFolder();

} // namespace pointrt
