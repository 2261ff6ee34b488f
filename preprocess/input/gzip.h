// SPDX-License-Identifier: GPL-3.0-or-later
// Scans packed with gzip.
#pragma once

#include "preprocess/input/source.h"

namespace pointrt {

bool isGzip(std::string_view bytes);

/// Replaces the bytes of source by what they unpack to. Throws Error when they are cut short or broken, and when they
/// unpack to more than 64 MiB and 100 bytes for each of theirs, or to more than 8 GiB.
void unpackGzip(Source& source);

} // namespace pointrt
