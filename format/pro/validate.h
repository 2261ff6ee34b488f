// SPDX-License-Identifier: Apache-2.0
// From untrusted bytes to a view whose every index is in range.
#pragma once

#include <span>

#include "format/pro/checks.h"

namespace pointrt::format {

struct Parsed {
    pro_info info{};
    Content content;      ///< only sections without findings are set
    bool indexed = false; ///< there is a whole index
};

/// Visits the findings of a whole file; with a sink that stops, returns soon after the first.
/// bytes must be 8-byte aligned. Time is linear in the file's size.
/// @param checksums whether the sections' XXH3 are compared; the header's always is
Parsed validate(std::span<const std::byte> bytes, Level level, bool checksums, Findings& findings);

} // namespace pointrt::format
