// SPDX-License-Identifier: GPL-3.0-or-later
// Detects the format of a file.
#pragma once

#include "preprocess/input/input_formats.h"

namespace pointrt {

/// The format with this name or, if it is "", detected from the content first and the suffix second.
/// Throws Error if the name is unknown (kBadUsage), or the format is unknown or not supported by this build.
const InputFormat& formatOf(const InputFile& input, std::string_view name);

/// Whether the suffix of a name, without ".gz", is that of a scan. .txt, .csv, .bin and .tif form their own class,
/// since other formats use them for their parts and pictures.
enum class SuffixOf { kScan, kText, kOther };
SuffixOf suffixKind(const std::string& name);

} // namespace pointrt
