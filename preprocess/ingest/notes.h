// SPDX-License-Identifier: GPL-3.0-or-later
// Notes for the user about input files.
#pragma once

#include <string>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Adds a note about a file. A text that is already there is not repeated: it only counts one more file.
void addNote(Cloud& cloud, const std::string& file, const std::string& text);

} // namespace pointrt
