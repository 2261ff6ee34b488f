// SPDX-License-Identifier: Apache-2.0
// What the window keeps from one run to the next: its colours, and which parts are open.
#pragma once

#include <string>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Reads them from the file "window" in folder. Unknown lines are ignored, such as those of other versions.
/// @param folder the user's state folder; may be empty
void readPreferences(const std::string& folder, Workspace& work);

/// Writes them; if the file cannot be written, it stays as it was.
void writePreferences(const std::string& folder, const Workspace& work);

} // namespace pointrt
