// SPDX-License-Identifier: GPL-3.0-or-later
// Which reader a source is for.
#pragma once

#include "preprocess/input/source/sink.h"

namespace pointrt {

using Reader = void (*)(const Source& source, Sink& sink);

/// Chooses by the name of a format as in ReadOptions::format, or, when it is "", by the content first and the suffix
/// second. Throws Error: unknown format name (usage); a known format that this build does not read, no known format.
Reader chooseReader(const Source& source, const std::string& format);

} // namespace pointrt
