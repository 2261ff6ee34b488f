// SPDX-License-Identifier: GPL-3.0-or-later
// Words of the command line about tile sets.
#pragma once

#include <string>

#include "preprocess/app/options.h"

namespace pointrt {

/// "4G", "800M", "500000K" or bytes; K is 1024 of them. Throws Error (kBadUsage).
std::uint64_t parseBytes(const std::string& option, const std::string& text);

/// "plan", "split", "block:N", "levels", "tile:N" or "top". Throws Error (kBadUsage).
void parseSetStep(const std::string& text, TileSetOptions& tiles);
/// Those, blanks between them, as far as the number.
std::string setStepWords();

/// JSON of all options that the bytes of a tile set depend on, by their names on the command line.
std::string tileSetSettings(const BakeOptions& options);

} // namespace pointrt
