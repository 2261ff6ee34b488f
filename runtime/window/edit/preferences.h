// SPDX-License-Identifier: Apache-2.0
// Preferences that the window keeps between runs: its colours, and which sections are open.
#pragma once

#include <string>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Reads the preferences from the file "window" in folder. Ignores unknown lines, such as those of other versions.
/// @param folder the user's state folder; may be empty
void readPreferences(const std::string& folder, Workspace& work);

/// Writes the preferences. A file that cannot be written stays unchanged.
void writePreferences(const std::string& folder, const Workspace& work);

} // namespace pointrt
