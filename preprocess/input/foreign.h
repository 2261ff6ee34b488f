// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are easily mistaken for supported scans.
#pragma once

#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// Throws Error, which names the format and gives advice, if the first bytes are those of a known but unsupported
/// format.
void refuseForeignStart(const InputFile& input);

/// The same by the suffix (lower case, without a dot), for formats without a signature.
void refuseForeignSuffix(const InputFile& input, std::string_view suffix);

} // namespace pointrt
