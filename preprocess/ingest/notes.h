// SPDX-License-Identifier: GPL-3.0-or-later
// Notes for the user about input files.
#pragma once

#include <string>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Adds a note about a file. A text that exists already is not repeated: its count of files is increased.
void addNote(Cloud& cloud, const std::string& file, const std::string& text);

} // namespace pointrt
