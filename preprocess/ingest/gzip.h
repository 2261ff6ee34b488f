// SPDX-License-Identifier: GPL-3.0-or-later
// Scans compressed with gzip.
#pragma once

#include "preprocess/ingest/input_file.h"

namespace pointrt {

bool isGzip(std::string_view bytes);

/// Replaces the bytes of input by their decompressed data. Throws Error if they are truncated or invalid, or expand to
/// more than 64 MiB plus 100 times their size, or to more than 8 GiB.
void unpackGzip(InputFile& input);

} // namespace pointrt
