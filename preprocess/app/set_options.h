// SPDX-License-Identifier: GPL-3.0-or-later
// Command line values for tile sets.
#pragma once

#include <string>

#include "preprocess/app/options.h"

namespace pointrt {

/// Parses "4G", "800M", "500000K" or bytes; K is 1024 bytes. Throws Error (kBadUsage).
std::uint64_t parseBytes(const std::string& option, const std::string& text);

/// Parses "plan", "split", "block:N", "levels", "tile:N" or "top". Throws Error (kBadUsage).
void parseSetStep(const std::string& text, TileSetOptions& tiles);
/// The names of all steps for shell completion, separated by spaces; numbered ones end in a colon.
std::string setStepWords();

/// JSON of all options that affect the bytes of a tile set, by their names on the command line.
std::string tileSetSettings(const BakeOptions& options);

} // namespace pointrt
