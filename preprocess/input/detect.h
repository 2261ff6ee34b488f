// SPDX-License-Identifier: GPL-3.0-or-later
// Which format a source is of.
#pragma once

#include "preprocess/input/formats.h"

namespace pointrt {

/// The format of that name or, when it is "", the one told by the content first and the suffix second.
/// Throws Error: unknown format name (usage); a known format that this build does not read, no known format.
const InputFormat& formatOf(const Source& source, std::string_view name);

/// Whether a name ends as those of scans do, ".gz" left out; .txt and .csv, which may be anything, apart.
enum class SuffixOf { kScan, kText, kOther };
SuffixOf suffixKind(const std::string& name);

} // namespace pointrt
