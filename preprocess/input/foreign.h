// SPDX-License-Identifier: GPL-3.0-or-later
// Files that people mistake for scans that this build reads.
#pragma once

#include <string_view>

#include "preprocess/input/source.h"

namespace pointrt {

/// Throws Error, which says what the file is and what to do, where its first bytes are those of a format that is known
/// but not read.
void refuseForeignStart(const Source& source);

/// As that, where its suffix (in lower case, without a dot) tells it: for formats whose bytes do not.
void refuseForeignSuffix(const Source& source, std::string_view suffix);

} // namespace pointrt
