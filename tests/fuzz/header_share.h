// SPDX-License-Identifier: Apache-2.0
// Counts mutants of .pro files that pass the header, after which most checks come.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "pointrt/pro.h"

namespace pointrt::fuzz {

/// Findings 1001 to 1999 concern the header, 2001 the shape of the table (format/SPEC.md).
inline bool passedHeader(pro_result result, std::uint32_t finding) { return result == PRO_OK || finding > 2001; }

struct HeaderShare {
    std::atomic<std::uint64_t> mutants{0}, passed{0}, opened{0};
};

inline HeaderShare& headerShare() {
    static HeaderShare share;
    return share;
}

/// Counts an attempt to open a file; prints the share when the process exits.
inline void countMutant(pro_result result, std::uint32_t finding) {
    [[maybe_unused]] static const int printed_at_exit = std::atexit([] {
        const HeaderShare& share = headerShare();
        std::fprintf(stderr, "past the header: %llu of %llu, opened: %llu\n",
                     static_cast<unsigned long long>(share.passed), static_cast<unsigned long long>(share.mutants),
                     static_cast<unsigned long long>(share.opened));
    });
    HeaderShare& share = headerShare();
    ++share.mutants;
    share.passed += passedHeader(result, finding);
    share.opened += result == PRO_OK;
}

} // namespace pointrt::fuzz
