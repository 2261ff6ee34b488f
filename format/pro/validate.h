// SPDX-License-Identifier: Apache-2.0
// Untrusted bytes to a view whose indices are all in range.
#pragma once

#include <span>

#include "format/pro/checks.h"

namespace pointrt::format {

struct Parsed {
    pro_info info{};
    Content content;      ///< only sections without findings are set
    bool indexed = false; ///< the file has a complete index
};

/// Checks a complete file; with a sink that stops, returns soon after the first finding. Linear in the size of the
/// file.
/// @param bytes 8-byte aligned
/// @param checksums whether to compare the XXH3 of the sections; the header's is always compared
Parsed validate(std::span<const std::byte> bytes, Level level, bool checksums, Findings& findings);

} // namespace pointrt::format
