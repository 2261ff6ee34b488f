// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/fuzz/fuzz_target.h"

namespace pointrt {
struct FormatReader;
}

namespace pointrt::fuzz {

/// Reads the input by a reader of scans: as a whole and, if the reader can, in batches.
void readScan(const FormatReader& reader, Input input);

} // namespace pointrt::fuzz
